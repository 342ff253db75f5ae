// The pointer: drag and pinch to move and zoom, wheel to zoom, hover for names.

class Pointer {
  /** @param changed called when the picture is to be painted again */
  constructor(stage, tip, changed) {
    this.stage = stage;
    this.tip = tip;
    this.changed = changed;
    this.down = new Map();
    const { canvas } = stage;
    canvas.addEventListener("pointerdown", (event) => this.press(event));
    canvas.addEventListener("pointermove", (event) => this.move(event));
    for (const type of ["pointerup", "pointercancel"]) {
      canvas.addEventListener(type, (event) => this.release(event));
    }
    canvas.addEventListener("pointerleave", () => this.hover(null, null));
    canvas.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
    canvas.addEventListener("dblclick", (event) => {
      this.zoom(event.shiftKey ? 1 / 4 : 4, ...this.at(event));
    });
  }

  at(event) {
    const box = this.stage.canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }

  zoom(factor, x, y) {
    const { stage } = this;
    stage.follow = false;
    stage.flight = null;
    stage.camera.zoom(factor, x, y);
    this.changed();
  }

  wheel(event) {
    event.preventDefault();
    const pixels = event.deltaY * [1, 16, 400][event.deltaMode];
    this.zoom(Math.exp(-Math.min(Math.max(pixels, -300), 300) / 250), ...this.at(event));
  }

  press(event) {
    this.stage.canvas.setPointerCapture(event.pointerId);
    this.down.set(event.pointerId, this.at(event));
    this.moved = 0;
    this.stage.canvas.classList.add("dragging");
  }

  release(event) {
    this.down.delete(event.pointerId);
    this.stage.canvas.classList.toggle("dragging", this.down.size > 0);
    // A tap has the effect of hovering.
    if (event.pointerType !== "mouse" && this.moved < 6) this.hover(...this.at(event));
  }

  move(event) {
    const here = this.at(event);
    if (!this.down.has(event.pointerId)) {
      this.hover(...here);
      return;
    }
    const before = [...this.down.values()];
    const old = this.down.get(event.pointerId);
    this.down.set(event.pointerId, here);
    const after = [...this.down.values()];
    this.moved += Math.hypot(here[0] - old[0], here[1] - old[1]);
    if (this.moved < 3) return;
    const [from, to] = [middleOf(before), middleOf(after)];
    const { stage } = this;
    stage.follow = false;
    stage.flight = null;
    stage.camera.pan(to[0] - from[0], to[1] - from[1]);
    if (after.length > 1) {
      stage.camera.zoom(spread(after) / Math.max(spread(before), 1), ...to);
    }
    this.hover(null, null);
    this.changed();
  }

  hover(x, y) {
    const { stage, tip } = this;
    const isNew = stage.hover(x, y);
    tip.hidden = stage.hovered === null;
    stage.canvas.classList.toggle("over", stage.hovered !== null);
    if (stage.hovered !== null) {
      this.write();
      const { width, height } = stage.camera;
      const [w, h] = [tip.offsetWidth, tip.offsetHeight];
      tip.style.left = `${Math.max(Math.min(x + 16, width - w - 8), 8)}px`;
      tip.style.top = `${y + 18 + h > height ? Math.max(y - h - 12, 8) : y + 18}px`;
    }
    if (isNew) this.changed();
  }

  /** Write the description of the hovered item. */
  write() {
    const [name, ...lines] = this.stage.words();
    this.tip.replaceChildren(made("b", name), ...lines.map((line) => made("span", line)));
  }
}

function middleOf(points) {
  return [0, 1].map((i) => points.reduce((sum, p) => sum + p[i], 0) / points.length);
}

function spread([a, b]) {
  return Math.hypot(a[0] - b[0], a[1] - b[1]);
}
