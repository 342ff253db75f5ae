// The player: the time that is shown, as an exact number, and its speed.

const SPEEDS = [8, 4, 2, 1, 1 / 2, 1 / 4, 1e-1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-9, 1e-12, 1e-15];
const FLASH = 1100;

class Player {
  constructor(film) {
    this.film = film;
    this.speed = 1;
    this.approach = null;
    this.isPlaying = false;
    this.changed = [0, 0];
    this.since = -Infinity;
    this.time = film.start;
    this.step = film.stepAt(film.start);
  }

  /** Time units per second at speed 1: one, if the film then lasts 6 to 60 seconds; else 1/20 of it. */
  get pace() {
    const span = toDouble(this.film.end - this.film.start, -BITS);
    const one = scaled(1, -this.film.timeUnit);
    return span >= 6 * one && span <= 60 * one ? one : span / 20;
  }

  /** Show a time, after its events. */
  seek(time) {
    const { film } = this;
    this.time = time < film.start ? film.start : time > film.end ? film.end : time;
    this.show(film.stepAt(this.time));
  }

  /** Show the time of a step, just after it. */
  goTo(step) {
    this.pause();
    const count = this.film.steps.length;
    const target = Math.min(Math.max(step, 0), count);
    this.time = this.film.timeOf(target);
    this.show(target);
    this.changed = [target - 1, target];
  }

  /** The next event, or the end. */
  forward() {
    if (this.step < this.film.steps.length) this.goTo(this.step + 1);
    else {
      this.pause();
      this.seek(this.film.end);
    }
  }

  /** The previous event; between two events the last one. */
  back() {
    const isThere = this.time === this.film.timeOf(this.step);
    this.goTo(isThere ? this.step - 1 : this.step);
  }

  show(step) {
    if (step !== this.step) {
      this.changed = step > this.step ? [this.step, step] : [0, 0];
      this.since = performance.now();
    }
    this.step = step;
  }

  play() {
    if (this.film.end === this.film.start) return;
    if (this.time >= this.film.end) this.seek(this.film.start);
    this.isPlaying = true;
    this.last = null;
  }

  pause() {
    this.isPlaying = false;
    this.approach = null;
  }

  /** Advance to the time of a frame. */
  tick(now) {
    if (!this.isPlaying) return;
    // After a pause of the page the film continues from where it was.
    const seconds = this.last === null ? 0 : Math.min((now - this.last) / 1000, 0.1);
    this.last = now;
    const pace = this.approach ?? this.pace * this.speed;
    this.seek(this.time + fromDouble(seconds * pace, BITS));
    if (this.time >= this.film.end) this.pause();
  }

  /** The edges that changed last, and their opacity. */
  flash(now) {
    const [from, to] = this.changed;
    if (to - from < 1 || to - from > 12 || to !== this.step || from < 0) return null;
    const isHeld = !this.isPlaying && this.time === this.film.timeOf(this.step);
    const strength = isHeld ? 1 : 1 - (now - this.since) / FLASH;
    if (strength <= 0) return null;
    const changes = this.film.steps.slice(from, to).flatMap((step) => step.changes);
    return {
      removed: changes.flatMap((change) => change[1]),
      added: changes.flatMap((change) => change[2]),
      strength,
      isHeld,
    };
  }
}
