// The controls: buttons, the scrubber, the keyboard, the theme, and their displays.

/** The colours on the ruler of what happens to bodies; what comes first is seen first. */
const MARKS = { contact: "contact", arrival: "added", departure: "removed", plan: "accent" };

class Controls {
  /** @param changed called when the picture is to be painted again */
  constructor(film, player, stage, panel, changed) {
    Object.assign(this, { film, player, stage, panel, changed });
    this.bindTransport();
    this.bindView();
    document.addEventListener("keydown", (event) => this.key(event));
  }

  on(id, act, type = "click") {
    byId(id).addEventListener(type, (event) => {
      act(event);
      this.changed();
    });
  }

  bindTransport() {
    const { film, player } = this;
    const speeds = byId("speed");
    for (const speed of SPEEDS) {
      const option = made("option", speedText(speed));
      option.value = speed;
      speeds.append(option);
    }
    speeds.value = 1;
    this.on("speed", () => this.setSpeed(Number(speeds.value)), "change");
    this.on("play", () => this.toggle());
    this.on("previous", () => player.back());
    this.on("next", () => player.forward());
    this.on("scrub", (event) => {
      player.pause();
      player.seek(film.start + this.share(Number(event.target.value)));
    }, "input");
    byId("scrub").disabled = film.end === film.start;
  }

  bindView() {
    const { stage } = this;
    for (const layer of Object.keys(stage.layers)) {
      this.on(`layer-${layer}`, () => this.toggleLayer(layer));
    }
    this.on("follow", () => this.toggleFollow());
    const { camera } = stage;
    const zoom = (factor) => {
      Object.assign(stage, { follow: false, flight: null });
      camera.zoom(factor, camera.width / 2, camera.height / 2);
    };
    this.zoom = zoom;
    this.on("closer", () => zoom(1.6));
    this.on("wider", () => zoom(1 / 1.6));
    this.on("fit", () => stage.fit());
    this.on("theme", () => this.toggleTheme());
    byId("help").addEventListener("click", () => byId("keys").showModal());
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
      stage.painter.readTheme();
      this.changed();
    });
  }

  /** The time at a share of the time span. */
  share(x) {
    const span = this.film.end - this.film.start;
    return x >= 1 ? span : shifted(span * BigInt(Math.round(x * 2 ** 52)), -52);
  }

  toggle() {
    if (this.player.isPlaying) this.player.pause();
    else this.player.play();
  }

  setSpeed(speed) {
    this.player.speed = speed;
    this.player.approach = null;
  }

  changeSpeed(by) {
    const i = SPEEDS.indexOf(this.player.speed) - by;
    this.setSpeed(SPEEDS[Math.min(Math.max(i, 0), SPEEDS.length - 1)]);
    byId("speed").value = this.player.speed;
  }

  toggleLayer(layer) {
    this.stage.layers[layer] = !this.stage.layers[layer];
  }

  toggleFollow() {
    this.stage.follow = !this.stage.follow;
    if (!this.stage.follow) this.stage.fit();
  }

  toggleTheme() {
    const root = document.documentElement;
    const isDark = root.dataset.theme
      ? root.dataset.theme === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
    root.dataset.theme = isDark ? "light" : "dark";
    this.stage.painter.readTheme();
  }

  key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey || byId("keys").open) return;
    const { tagName } = event.target;
    // Keys with a meaning of their own in the focused element keep it.
    if (tagName === "SELECT" || (tagName === "BUTTON" && [" ", "Enter"].includes(event.key))) return;
    const { player, stage } = this;
    const little = (sign) => {
      player.pause();
      const pace = fromDouble((player.pace * player.speed) / 10, BITS);
      player.seek(player.time + BigInt(sign) * pace);
    };
    const keys = {
      " ": () => this.toggle(),
      ArrowLeft: () => (event.shiftKey ? little(-1) : player.back()),
      ArrowRight: () => (event.shiftKey ? little(1) : player.forward()),
      Home: () => player.goTo(0),
      End: () => { player.pause(); player.seek(this.film.end); },
      "[": () => this.changeSpeed(-1),
      "]": () => this.changeSpeed(1),
      "+": () => this.zoom(1.6),
      "=": () => this.zoom(1.6),
      "-": () => this.zoom(1 / 1.6),
      f: () => stage.fit(),
      w: () => this.toggleFollow(),
      c: () => stage.visitContact(),
      a: () => stage.replayApproach(),
      d: () => this.toggleLayer("edges"),
      b: () => this.toggleLayer("bridges"),
      s: () => this.toggleLayer("shadows"),
      x: () => this.toggleLayer("next"),
      n: () => this.toggleLayer("names"),
      t: () => this.toggleTheme(),
      "?": () => byId("keys").showModal(),
    };
    if (event.target.id === "events") {
      keys.ArrowUp = keys.ArrowLeft;
      keys.ArrowDown = keys.ArrowRight;
    }
    const act = keys[event.key];
    if (act === undefined) return;
    event.preventDefault();
    act();
    this.changed();
  }

  /** Update the time, the step, the ruler and the state of the buttons. */
  write() {
    const { film, player, stage, panel } = this;
    const { camera } = stage;
    const span = film.end - film.start;
    const isAtStep = player.step > 0 && player.time === film.timeOf(player.step);
    const digits = 6 + Math.max(Math.ceil(Math.log10(camera.magnification)), 0);
    this.put("time", isAtStep ? film.stepText(player.step)
      : `t = ${film.timeText(player.time, digits)}`);
    const count = film.steps.length;
    this.put("where", this.whereText(isAtStep, count));
    byId("where").classList.toggle("hit", film.isContact(player.step, player.time));
    const share = span > 0n ? toDouble(((player.time - film.start) << 52n) / span, -52) : 0;
    const scrub = byId("scrub");
    if (document.activeElement !== scrub || Number(scrub.value) !== share) scrub.value = share;
    const now = byId("now");
    if (now !== null) now.style.left = `${100 * share}%`;
    scrub.setAttribute("aria-valuetext", `${byId("time").textContent}, ${player.step} of ${count}`);
    document.body.classList.toggle("playing", player.isPlaying);
    byId("play").setAttribute("aria-label", player.isPlaying ? "Pause" : "Play");
    for (const [layer, isOn] of Object.entries(stage.layers)) {
      byId(`layer-${layer}`).setAttribute("aria-pressed", isOn);
    }
    byId("follow").setAttribute("aria-pressed", stage.follow);
    this.writeRuler(camera);
    if (!player.isPlaying && panel.step !== player.step) {
      this.put("news", `${byId("time").textContent}. ${byId("where").textContent}`);
    }
    panel.update(player.step);
  }

  whereText(isAtStep, count) {
    const { film, player } = this;
    if (film.isContact(player.step, player.time)) return `first contact: ${film.contact.words}`;
    if (!count) return "no events";
    if (player.step === 0) return count === 1 ? "before the only event time"
      : `before the first of ${count} event times`;
    const kinds = [...new Set(film.steps[player.step - 1].changes.map(([kind]) => kind))];
    return `${isAtStep ? "at" : "after"} ${player.step} of ${count}: ${kinds.join(", ")}`;
  }

  writeRuler(camera) {
    const { lengthUnit } = this.film;
    const exponent = Math.log10(110 / camera.scale) + lengthUnit * Math.log10(2);
    const power = Math.floor(exponent);
    const digit = [5, 2, 1].find((d) => Math.log10(d) <= exponent - power);
    const width = 110 * 10 ** (Math.log10(digit) + power - exponent);
    byId("bar").style.width = `${width.toFixed(1)}px`;
    const isPlain = power > -5 && power < 6;
    const length = isPlain ? String(Number(`${digit}e${power}`)) : `${digit}e${power}`;
    const { magnification } = camera;
    this.put("length", magnification > 1.05
      ? `${length}   (×${magnification < 1e5 ? magnification.toPrecision(3) : magnification.toExponential(1)})`
      : length);
  }

  put(id, text) {
    const element = byId(id);
    if (element.textContent !== text) element.textContent = text;
  }

  /** Draw a tick for every event above the scrubber. */
  drawTicks() {
    const canvas = byId("ticks");
    const ratio = window.devicePixelRatio || 1;
    canvas.width = Math.round(canvas.clientWidth * ratio);
    canvas.height = Math.round(canvas.clientHeight * ratio);
    const context = canvas.getContext("2d");
    const { film, stage } = this;
    const span = film.end - film.start;
    if (span === 0n) return;
    const faint = Math.max(0.12, Math.min(0.6, 90 / film.steps.length));
    for (const { time, changes } of film.steps) {
      const x = toDouble(((time - film.start) << 40n) / span, -40) * (canvas.width - 2 * ratio);
      const kind = Object.keys(MARKS).find((mark) => changes.some(([k]) => k === mark));
      context.globalAlpha = kind ? 1 : faint;
      context.fillStyle = stage.painter.colours[MARKS[kind] ?? "soft"];
      context.fillRect(x, kind ? 0 : canvas.height * 0.3, (kind ? 2 : 1) * ratio, canvas.height);
    }
  }
}

function speedText(speed) {
  if (speed >= 1) return `× ${speed}`;
  return speed > 0.2 ? `× 1/${1 / speed}` : `× ${speed < 1e-3 ? speed.toExponential(0) : speed}`;
}
