// Films of what engines did, recorded when the handouts were made, on the stage that replays use.
//
// A film runs when its figure comes into view: no page waits for it. It is inside the page, as the
// text of the script script-film-NAME, or else a file films/NAME.js.
"use strict";

const films = {
  folder: document.currentScript.src.replace(/films\.js.*$/, "films/"),
  waiting: new Map(),

  /** Hand the film of this name to `then`, now or when it has come. */
  load(name, then) {
    films.waiting.set(name, then);
    const inside = document.getElementById(`script-film-${name}`);
    const script = inside
      ? touch.element("script", {}, inside.textContent)
      : touch.element("script", { src: `${films.folder}${name}.js` });
    document.head.append(script);
  },

  /** Do something once, when an element is about to be seen. */
  whenSeen(element, then) {
    const watch = new IntersectionObserver(
      (entries) => {
        if (!entries.some((each) => each.isIntersecting)) return;
        watch.disconnect();
        then();
      },
      { rootMargin: "300px" },
    );
    watch.observe(element);
  },
};

/** What each file of a film calls. */
touch.film = (name, data) => {
  films.waiting.get(name)?.(data);
  films.waiting.delete(name);
};

/** A canvas on which a scene runs at its own speed, again and again; still until it is started. */
class Projector {
  constructor(label) {
    this.canvas = touch.element("canvas", { role: "img", "aria-label": label });
    this.stage = stageOn(this.canvas);
    this.frame = 0;
    this.playing = false;
    this.seen = false;
    new IntersectionObserver((entries) => {
      this.seen = entries.at(-1).isIntersecting;
    }).observe(this.canvas);
    new ResizeObserver(() => this.draw()).observe(this.canvas);
    new MutationObserver(() => this.draw()).observe(document.body, { attributes: true }); // light, dark
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.draw());
  }

  /** Put in another scene; a film that runs goes on at the same shot. */
  show(scene) {
    this.scene = this.stage.prepare(scene);
    this.frame = Math.min(this.frame, this.last);
    this.draw();
  }

  get last() {
    return this.scene.yours.length - 1;
  }

  draw() {
    if (!this.scene) return;
    this.stage.readColours();
    const { scene, frame } = this;
    scene.arrows = 0; // speeds are to be seen, not read
    this.stage.draw({ scene, yours: scene.yours[frame], expected: scene.expected[frame] });
    this.canvas.dataset.frame = frame;
  }

  go(frame) {
    this.frame = Math.max(0, Math.min(frame, this.last));
    this.draw();
  }

  /** How long the scene takes, s. */
  get length() {
    return this.scene.yours[this.last].time;
  }

  /** Run from here on. With others, all from their start: they keep step, and wait for the longest. */
  play(others = []) {
    if (this.playing) return;
    this.playing = true;
    if (this.frame === this.last || others.length) this.frame = 0;
    const all = [this, ...others];
    let begun = performance.now() - 1000 * this.scene.yours[this.frame].time;
    const REST = 0.8; // s, on the last shot
    const next = (now) => {
      if (!this.playing || !this.canvas.isConnected) return;
      requestAnimationFrame(next);
      if (!all.some((each) => each.seen)) return;
      const passed = (now - begun) / 1000;
      if (passed > Math.max(...all.map((each) => each.length)) + REST) begun = now;
      for (const each of all) each.goTo(passed);
    };
    requestAnimationFrame(next);
  }

  /** Show the shot of a time, s. */
  goTo(seconds) {
    const at = this.scene.yours.findIndex((each) => each.time > Math.min(seconds, this.length));
    this.go(at < 0 ? this.last : Math.max(0, at - 1));
  }

  stop() {
    this.playing = false;
  }
}
