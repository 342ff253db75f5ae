// The panel: the contact, the next failure, and the list of events.

const ROW = 44;

class Panel {
  /** @param act the actions of buttons and rows: `goTo`, `visit`, `approach` */
  constructor(film, act) {
    this.film = film;
    this.act = act;
    this.list = byId("events");
    this.rows = byId("rows");
    this.shown = new Map();
    this.step = -1;
    this.rows.style.height = `${film.rows.length * ROW}px`;
    byId("count").textContent = film.rows.length ? `· ${film.rows.length}` : "· none";
    this.list.addEventListener("scroll", () => this.fill());
    this.list.addEventListener("click", (event) => {
      const row = event.target.closest(".row");
      if (row) act.goTo(Number(row.dataset.step));
    });
    byId("legend-fan").hidden = !film.edges.some(({ kind }) => kind === "fan");
    this.writeContact();
  }

  writeContact() {
    const { film } = this;
    const card = byId("contact");
    if (film.contact === null) {
      const { length } = film.rows.filter(({ change: [kind] }) => kind === "contact");
      if (length) card.append(made("h2", "Contacts"), made("p", `${length}, each with an answer`));
      else card.append(made("h2", "First contact"), made("p", `None up to t = ${film.endText}`));
      return;
    }
    card.classList.add("hit");
    const { kind, pairs, overlaps } = film.contact;
    const step = film.steps.length;
    const list = made("ul");
    for (const { words } of pairs) list.append(made("li", words));
    for (const words of overlaps) list.append(made("li", words));
    const exactly = made("details");
    exactly.append(made("summary", "exactly"), made("p", film.exactText(step)));
    const actions = made("div", "", "actions");
    actions.append(
      button("to-contact", "Zoom to it", "Zoom to the contact; again: 1000 times closer (c)",
        () => this.act.visit()));
    if (film.end > film.start && pairs.length) {
      actions.append(button("approach", "Replay the approach",
        "The last moments, at this magnification (a)", () => this.act.approach()));
    }
    card.append(made("h2", `First contact, ${kind}`), made("b", film.stepText(step)), list,
      exactly, actions);
  }

  /** Mark the current step. */
  update(step) {
    if (step === this.step) return;
    this.step = step;
    this.writeUpcoming();
    const { rows } = this.film;
    this.current = rows.findLastIndex((row) => row.step <= step);
    const top = Math.max(this.current, 0) * ROW;
    const { scrollTop, clientHeight } = this.list;
    if (top < scrollTop + ROW || top > scrollTop + clientHeight - 2 * ROW) {
      this.list.scrollTop = top - clientHeight / 2 + ROW;
    }
    for (const row of this.shown.values()) row.remove();
    this.shown.clear();
    this.fill();
  }

  writeUpcoming() {
    const { film, step } = this;
    const card = byId("upcoming");
    const next = film.steps[step];
    card.replaceChildren(made("h2", next && !next.certificate.length ? "Next" : "Fails next"));
    if (!next) {
      card.append(made("p", film.contact ? "Nothing: the bodies touch." : "Nothing until the end."));
      return;
    }
    const kinds = [...new Set(next.changes.map(([kind]) => kind))].join(", ");
    const names = next.certificate.map((v) => film.name(v));
    const what = names.length === 3 ? `${names.join(", ")} become collinear`
      : names.length === 2 ? `${names.join(" and ")} come to lie above one another`
      : kinds === "motion" ? "a body begins its next piece of motion" : "";
    card.append(made("p", `${kinds} at ${film.stepText(step + 1)}`));
    if (what) card.append(made("p", what, "soft"));
  }

  /** Create the rows that are in view. */
  fill() {
    const { film, list, shown } = this;
    const first = Math.max(Math.floor(list.scrollTop / ROW) - 4, 0);
    const last = Math.min(Math.ceil((list.scrollTop + list.clientHeight) / ROW) + 4,
      film.rows.length);
    for (const [i, row] of shown) {
      if (i < first || i >= last) {
        row.remove();
        shown.delete(i);
      }
    }
    for (let i = first; i < last; i += 1) {
      if (!shown.has(i)) {
        shown.set(i, this.row(i));
        this.rows.append(shown.get(i));
      }
    }
  }

  row(i) {
    const { step, change: [kind, removed, added, words] } = this.film.rows[i];
    const row = made("div", "", "row");
    row.id = `row-${i}`;
    row.dataset.step = step;
    row.style.top = `${i * ROW}px`;
    row.setAttribute("role", "option");
    row.setAttribute("aria-posinset", i + 1);
    row.setAttribute("aria-setsize", this.film.rows.length);
    row.setAttribute("aria-selected", step === this.step);
    row.classList.toggle("ahead", step > this.step);
    row.title = `${this.film.stepText(step)}\n${this.film.exactText(step).slice(0, 600)}`;
    row.append(made("i", "", `kind-${kind}`), made("span", kind, "kind"),
      made("span", this.film.timeText(this.film.timeOf(step), 7), "when"),
      made("span", words ?? this.change(kind, removed, added), "what"));
    if (step === this.step) this.list.setAttribute("aria-activedescendant", row.id);
    return row;
  }

  change(kind, removed, added) {
    const names = (pairs) => pairs.map(([u, v]) => `${this.film.name(u)}–${this.film.name(v)}`);
    if (kind === "contact") return "the first contact";
    if (kind === "motion") return "a body begins its next piece of motion";
    return [...names(removed).map((n) => `− ${n}`), ...names(added).map((n) => `+ ${n}`)].join("  ");
  }
}

function byId(id) {
  return document.getElementById(id);
}

function made(tag, text = "", className = "") {
  const element = document.createElement(tag);
  element.textContent = text;
  element.className = className;
  return element;
}

function button(id, text, title, act) {
  const element = made("button", text);
  element.id = id;
  element.type = "button";
  element.title = title;
  element.addEventListener("click", act);
  return element;
}
