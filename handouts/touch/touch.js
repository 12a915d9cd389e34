// Figures that can be moved.
//
// A page holds a still picture, figures/NAME.svg. A script beside this one makes the figure of that
// name, or all of a kind (figures/KIND-NAME.svg): it replaces the picture on the screen, by a drawing with handles, sliders and a sentence that
// says what is seen. The picture stays for paper, and for readers whose browser runs no script.
//
// Drawings are in px, y grows down. All is drawn anew at each change, as wide as the page is.
"use strict";

const touch = {
  /** Make all figures of this name or kind; `build(figure)` adds parts and returns what draws them. */
  figure(kind, build) {
    for (const still of document.querySelectorAll("img")) {
      const [, name] = touch.place(still).match(/figures\/(.*)\.svg$/) ?? [];
      if (name === kind || name?.startsWith(`${kind}-`)) new Figure(name, still, build);
    }
  },

  /** Where a picture comes from; one that is inside the page says it beside its content. */
  place(still) {
    return still.dataset.figure ?? still.src;
  },

  /** An element with these attributes and children; `svg:` before the name makes one of a drawing. */
  element(name, attributes = {}, ...children) {
    const made = name.startsWith("svg:")
      ? document.createElementNS("http://www.w3.org/2000/svg", name.slice(4))
      : document.createElement(name);
    for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
    made.append(...children);
    return made;
  },

  /** A piece of a line as a curve is drawn; a dot where its dashes are none, "0 ...". */
  sample(color, dash = "") {
    const style = `stroke: var(--${color}); stroke-width: 4; fill: var(--${color})`;
    const line = { x1: 0, y1: 6, x2: 28, y2: 6, style, "stroke-dasharray": dash };
    const drawn = touch.element("svg:svg", { "aria-hidden": true }, touch.element("svg:line", line));
    if (dash.startsWith("0")) drawn.append(touch.element("svg:circle", { cx: 14, cy: 6, r: 4, style }));
    return drawn;
  },

  /** A number with so many digits after the point, and no minus before nothing. */
  number(value, digits = 0) {
    const words = value.toFixed(digits);
    return words.replace("-", Number(words) ? "\u2212" : "");
  },
};

const WAYS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

class Figure {
  constructor(name, still, build) {
    const { element } = touch;
    this.name = name;
    this.paint = element("svg:g");
    this.grips = element("svg:g");
    this.picture = element("svg:svg", { role: "group", "aria-label": still.alt });
    this.picture.append(this.paint, this.grips);
    this.controls = element("div", { class: "controls" });
    this.words = element("output", { "aria-live": "polite" });
    this.box = element("figure", { class: "touch", "data-figure": name });
    const alone = still.parentElement.children.length === 1 && !still.parentElement.innerText.trim();
    (alone ? still.parentElement : still).replaceWith(this.box);
    this.box.append(this.picture, this.controls, this.words, still);
    still.classList.add("still");
    this.handles = [];
    this.height = 260;
    this.draw = build(this);
    new ResizeObserver(() => this.redraw()).observe(this.box);
    this.redraw();
  }

  /** How wide the drawing is, px. */
  get width() {
    return Math.max(this.picture.clientWidth, 260);
  }

  redraw() {
    this.paint.replaceChildren();
    this.draw();
    this.picture.setAttribute("viewBox", `0 0 ${this.width} ${this.height}`);
    this.picture.style.height = `${this.height}px`;
    for (const handle of this.handles) handle.place();
  }

  /** Say in words what the figure shows just now. */
  say(words) {
    if (this.words.textContent !== words) this.words.textContent = words;
  }

  // ------------------------------------------------------------ what can be moved

  /** A slider; read its `value`. `show` turns the value into the words beside it. */
  slider(label, { min, max, step, value, show = String }) {
    const input = touch.element("input", { type: "range", min, max, step, value });
    const words = touch.element("span");
    const control = {
      min,
      max,
      get value() {
        return Number(input.value);
      },
      set value(number) {
        input.value = number;
        tell();
      },
    };
    const tell = () => {
      words.textContent = show(control.value);
      input.setAttribute("aria-valuetext", words.textContent);
    };
    tell();
    input.addEventListener("input", () => {
      tell();
      this.redraw();
    });
    this.controls.append(touch.element("label", {}, label, input, words));
    return control;
  }

  /** A box to tick; read its `checked`. A color, and the dashes of a line, show what it stands for. */
  tick(label, checked, color = "", dash = "") {
    const input = touch.element("input", { type: "checkbox" });
    input.checked = checked;
    input.addEventListener("change", () => this.redraw());
    const sample = color ? [touch.sample(color, dash)] : [];
    this.controls.append(touch.element("label", { class: "tick" }, input, ...sample, label));
    return input;
  }

  button(label, pressed) {
    const button = touch.element("button", { type: "button" }, label);
    button.addEventListener("click", () => {
      pressed();
      this.redraw();
    });
    this.controls.append(button);
    return button;
  }

  /** A button that lets a slider of seconds run in real time, from its start when it is at its end. */
  plays(control, label) {
    let begun = null; // ms, when the slider stood at its start
    const tell = () => {
      button.textContent = begun === null ? label : "Stop";
      this.words.setAttribute("aria-live", begun === null ? "polite" : "off");
    };
    const run = (now) => {
      if (begun === null || !this.box.isConnected) return;
      control.value = Math.min(control.min + Math.max(now - begun, 0) / 1000, control.max);
      if (control.value < control.max) requestAnimationFrame(run);
      else begun = null;
      tell();
      this.redraw();
    };
    const button = this.button(label, () => {
      const from = control.value < control.max ? control.value : control.min;
      begun = begun === null ? performance.now() - 1000 * (from - control.min) : null;
      tell();
      requestAnimationFrame(run);
    });
  }

  /**
   * A handle that a pointer drags and arrow keys push: by 5 px, with Shift by 1.
   *
   * `at()` says where it is, `move(x, y)` puts what it stands for there.
   */
  handle(label, at, move) {
    const { element } = touch;
    const name = `${label}. Arrow keys move it.`;
    const grip = element("svg:circle", { class: "grip", r: 7 });
    const handle = element("svg:g", { class: "handle", tabindex: 0, role: "button" });
    handle.setAttribute("aria-label", name);
    handle.append(element("svg:circle", { r: 22 }), grip);
    this.grips.append(handle);
    const put = (x, y) => {
      move(x, y);
      this.redraw();
    };
    handle.place = () => {
      const { x, y } = at();
      handle.setAttribute("transform", `translate(${x} ${y})`);
    };
    handle.addEventListener("pointerdown", (event) => {
      handle.setPointerCapture(event.pointerId);
      event.preventDefault();
      handle.focus();
    });
    handle.addEventListener("pointermove", (event) => {
      if (!handle.hasPointerCapture(event.pointerId)) return;
      const { left, top } = this.picture.getBoundingClientRect();
      put(event.clientX - left, event.clientY - top);
    });
    handle.addEventListener("keydown", (event) => {
      const way = WAYS[event.key];
      if (!way) return;
      event.preventDefault();
      const far = event.shiftKey ? 1 : 5;
      const { x, y } = at();
      put(x + far * way[0], y + far * way[1]);
    });
    this.handles.push(handle);
  }

  /**
   * Parts of the drawing are read: `at(x, y, pressed)` chooses what is pointed at, `go(dx, dy)` a
   * neighbour.
   */
  reading(at, go) {
    this.picture.setAttribute("tabindex", 0);
    this.picture.style.touchAction = "pan-y"; // a finger that goes up or down moves the page
    const pointed = (event) => {
      const { left, top } = this.picture.getBoundingClientRect();
      at(event.clientX - left, event.clientY - top, event.buttons > 0);
      this.redraw();
    };
    this.picture.addEventListener("pointerdown", pointed);
    this.picture.addEventListener("pointermove", pointed);
    this.picture.addEventListener("keydown", (event) => {
      const way = WAYS[event.key];
      if (!way) return;
      event.preventDefault();
      go(...way);
      this.redraw();
    });
  }

  // ------------------------------------------------------------ drawing

  add(name, attributes, text = "") {
    this.paint.append(touch.element(`svg:${name}`, attributes, text));
  }

  line(points, color = "ink", width = 2, dash = "") {
    const path = points.map(({ x, y }) => `${x.toFixed(2)},${y.toFixed(2)}`).join(" ");
    const style = `fill: none; stroke: var(--${color}); stroke-width: ${width}`;
    this.add("polyline", { points: path, style, "stroke-dasharray": dash });
  }

  /** A line with a head at its end. */
  arrow(from, to, color = "ink", width = 2) {
    const long = Math.hypot(to.x - from.x, to.y - from.y);
    if (long < 1) return;
    this.line([from, to], color, width);
    const back = Math.atan2(from.y - to.y, from.x - to.x);
    const size = Math.min(9, long);
    const sides = [-0.45, 0.45].map((turn) => ({
      x: to.x + size * Math.cos(back + turn),
      y: to.y + size * Math.sin(back + turn),
    }));
    const path = [sides[0], to, sides[1]].map(({ x, y }) => `${x},${y}`).join(" ");
    this.add("polygon", { points: path, style: `fill: var(--${color})` });
  }

  circle({ x, y }, r, { fill = "none", stroke = "none", width = 2, opacity = 1 } = {}) {
    const style = `fill: ${paint(fill)}; fill-opacity: ${opacity}; stroke: ${paint(stroke)}`;
    this.add("circle", { cx: x, cy: y, r, style: `${style}; stroke-width: ${width}` });
  }

  rect(x, y, width, height, fill, stroke = "none") {
    const size = { width: Math.max(width, 0), height: Math.max(height, 0) };
    this.add("rect", { x, y, ...size, style: `fill: ${paint(fill)}; stroke: ${paint(stroke)}` });
  }

  text(x, y, words, { color = "ink", anchor = "start", size = 14, bold = false } = {}) {
    const style = `fill: var(--${color}); font-size: ${size}px; font-weight: ${bold ? 600 : 400}`;
    this.add("text", { x, y, "text-anchor": anchor, style }, words);
  }

  /** Axes with their numbers; returns what turns values into places. */
  axes({ left, top, width, height, x, y, xs, ys, xName, yName, xShow = String, yShow = String }) {
    const at = (u, v) => ({
      x: left + (width * (u - x[0])) / (x[1] - x[0]),
      y: top + height * (1 - (v - y[0]) / (y[1] - y[0])),
    });
    for (const v of ys) {
      this.line([at(x[0], v), at(x[1], v)], "pale", 1);
      this.text(left - 6, at(0, v).y + 5, yShow(v), { color: "grey", anchor: "end", size: 12 });
    }
    for (const u of xs) {
      const place = { color: "grey", anchor: "middle", size: 12 };
      this.text(at(u, 0).x, top + height + 17, xShow(u), place);
    }
    this.line([at(x[0], y[1]), at(x[0], y[0]), at(x[1], y[0])], "grey", 1);
    this.text(left + width / 2, top + height + 36, xName, { anchor: "middle", size: 13 });
    this.text(left - 6, top - 10, yName, { size: 13 });
    return at;
  }
}

function paint(color) {
  return color === "none" ? color : `var(--${color})`;
}
