// The program's window: draws what Python sends, and sends what people do there.
const KEYDOWN = 768, KEYUP = 769, MOUSEMOTION = 1024, BUTTONDOWN = 1025, BUTTONUP = 1026, WHEEL = 1027;
const FONT = 18 / 26; // px of a bold Arial that is as wide as 1 px of pygame's font
const SPECIAL = {
  Backspace: 8, Enter: 13, Escape: 27, Delete: 127,
  ArrowRight: 0x4000004f, ArrowLeft: 0x40000050, ArrowDown: 0x40000051, ArrowUp: 0x40000052,
  Control: 0x400000e0, Shift: 0x400000e1, Alt: 0x400000e2,
};

export class Stage {
  constructor(canvas, send) {
    this.canvas = canvas;
    this.pen = canvas.getContext("2d");
    this.send = send;
    this.last = null;
    this.pictures = 0;
    for (const [name, type] of [["keydown", KEYDOWN], ["keyup", KEYUP]]) {
      canvas.addEventListener(name, (event) => this.press(type, event));
    }
    canvas.addEventListener("pointerdown", (event) => this.point(BUTTONDOWN, event));
    canvas.addEventListener("pointerup", (event) => this.point(BUTTONUP, event));
    canvas.addEventListener("pointermove", (event) => this.point(MOUSEMOTION, event));
    canvas.addEventListener("wheel", (event) => send(WHEEL, 0, -Math.sign(event.deltaY)), { passive: true });
  }

  // Keep the newest picture, and draw it when the browser shows the next one.
  take(picture) {
    if (!this.last) requestAnimationFrame(() => this.drawLast());
    this.last = picture;
    this.pictures += 1;
  }

  drawLast() {
    const { commands, width, height } = this.last;
    this.last = null;
    if (this.canvas.width !== width || this.canvas.height !== height) {
      Object.assign(this.canvas, { width, height });
    }
    this.draw(JSON.parse(commands));
  }

  draw(commands) {
    for (const [name, ...values] of commands) this[name](...values);
  }

  point(type, event) {
    const { canvas } = this, box = canvas.getBoundingClientRect();
    const x = Math.floor((event.clientX - box.left) * canvas.width / box.width);
    const y = Math.floor((event.clientY - box.top) * canvas.height / box.height);
    if (type === BUTTONDOWN) canvas.focus();
    this.send(type, x, y, type === MOUSEMOTION ? event.buttons : event.button + 1);
  }

  // Tab and combinations with Ctrl stay the browser's, so that the keyboard can leave the window.
  press(type, event) {
    const key = event.key.length === 1 ? event.key.toLowerCase().codePointAt(0) : SPECIAL[event.key];
    if (!key || event.ctrlKey || event.metaKey) return;
    event.preventDefault();
    if (!event.repeat) this.key(type, key, event.key.length === 1 ? event.key.codePointAt(0) : 0);
  }

  key(type, key, letter = key) {
    this.send(type, key, 0, letter);
  }

  type(letter) {
    const key = letter.codePointAt(0);
    this.key(KEYDOWN, key);
    this.key(KEYUP, key);
  }

  // ------------------------------------------------------------ draw commands

  // Fill a path, or draw its line.
  paint(colour, width) {
    const { pen } = this;
    pen.fillStyle = pen.strokeStyle = colour;
    pen.lineWidth = width;
    width ? pen.stroke() : pen.fill();
  }

  rect(x, y, w, h, colour, width, radius = 0) {
    this.pen.beginPath();
    radius ? this.pen.roundRect(x, y, w, h, radius) : this.pen.rect(x, y, w, h);
    this.paint(colour, width);
  }

  circle(x, y, radius, colour, width) {
    this.pen.beginPath();
    this.pen.arc(x, y, radius - width / 2, 0, 2 * Math.PI);
    this.paint(colour, width);
  }

  line(x, y, toX, toY, colour, width) {
    this.pen.beginPath();
    this.pen.moveTo(x, y);
    this.pen.lineTo(toX, toY);
    this.paint(colour, width);
  }

  poly(places, colour, width) {
    this.pen.beginPath();
    for (let i = 0; i < places.length; i += 2) this.pen.lineTo(places[i], places[i + 1]);
    this.pen.closePath();
    this.paint(colour, width);
  }

  text(x, y, text, colour, size) {
    this.pen.font = `bold ${size * FONT}px Arial, Helvetica, sans-serif`;
    this.pen.textBaseline = "top";
    this.pen.fillStyle = colour;
    this.pen.fillText(text, x, y);
  }

  at(x, y, commands) {
    this.pen.save();
    this.pen.translate(x, y);
    this.draw(commands);
    this.pen.restore();
  }

  within(x, y, w, h, commands) {
    this.pen.save();
    this.pen.beginPath();
    this.pen.rect(x, y, w, h);
    this.pen.clip();
    this.draw(commands);
    this.pen.restore();
  }

}
