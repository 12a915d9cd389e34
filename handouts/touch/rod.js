// Two rods that share a ball: what each asks for, and how it comes about pass by pass.
"use strict";

touch.figure("rod", (figure) => {
  const kg = (mass) => (mass ? `${mass} kg` : "static");
  const masses = [["A", 0, 0], ["B", 1, 1], ["C", 1, 3]].map(([name, min, value]) =>
    figure.slider(`mass of ${name}`, { min, max: 8, step: 1, value, show: kg }),
  ); // prettier-ignore
  const passes = figure.slider("passes", { min: 1, max: 8, step: 1, value: 2 });
  const LENGTH = 100; // px
  const START = [-120, 10, 125]; // px, along the rods, from the middle of the drawing
  const FLOOR = 330; // px, the foot of the bars
  const COLORS = ["orange", "blue"]; // of the rods
  const places = [...START];
  figure.button("One step", () => {
    solved(passes.value).speeds.forEach((speed, n) => {
      places[n] += speed * laws.STEP;
    });
  });
  figure.button("Again", () => places.splice(0, 3, ...START));
  const at = (n) => ({ x: figure.width / 2 + places[n], y: 76 });
  for (const n of [1, 2]) {
    figure.handle("ABC"[n], () => at(n), (x) => {
      const room = figure.width / 2 - 26;
      const [low, high] = n === 1 ? [places[0] + 40, places[2] - 40] : [places[1] + 40, room];
      places[n] = Math.min(Math.max(x - figure.width / 2, low), high);
    });
  }
  figure.height = 362;

  const errors = () => [0, 1].map((n) => places[n + 1] - places[n] - LENGTH); // px
  function solved(many) {
    const all = { masses: masses.map(({ value }) => value), errors: errors(), dt: laws.STEP };
    return laws.chainSolved({ ...all, passes: many });
  }

  return () => {
    const { meant, after, speeds } = solved(passes.value);
    errors().forEach((error, n) => {
      const [from, to] = [at(n), at(n + 1)];
      figure.line([from, to], COLORS[n], 4);
      const y = from.y + 58 + 6 * n;
      figure.line([{ x: from.x, y }, { x: from.x + LENGTH, y }], "green", 3);
      if (Math.abs(error) >= 0.5) figure.line([{ x: from.x + LENGTH, y }, { x: to.x, y }], "red", 3);
    });
    figure.text(at(0).x, at(0).y + 84, `green: as meant, ${LENGTH} px`, { color: "green", size: 13 });
    masses.forEach(({ value }, n) => ball(at(n), value, "ABC"[n], speeds[n]));
    bars(meant);
    figure.say(words(meant, after.at(-1)));
  };

  function ball(c, mass, name, speed) {
    const r = mass ? 10 + 2 * mass : 12;
    if (mass) figure.circle(c, r, { fill: "blue", stroke: "ink", opacity: 0.2, width: 1 });
    else figure.rect(c.x - r, c.y - r, 2 * r, 2 * r, "fixed");
    figure.text(c.x, c.y - r - 6, name, { anchor: "middle", bold: true });
    const y = c.y + 38;
    figure.arrow({ x: c.x, y }, { x: c.x + 0.06 * speed, y }, "red", 3);
  }

  /** What each rod's speed is off after each pass; those beyond the chosen number are pale. */
  function bars(meant) {
    const missing = solved(passes.max).after.map((speeds) => speeds.map((speed, n) => Math.abs(speed - meant[n])));
    const most = Math.max(...meant.map(Math.abs), ...missing.flat(), 1e-9);
    const room = (figure.width - 16) / passes.max;
    figure.text(8, 192, "off after each pass, px/s", { size: 13 });
    figure.text(figure.width - 58, 192, "AB", { color: "orange", anchor: "end", size: 13, bold: true });
    figure.text(figure.width - 30, 192, "BC", { color: "blue", anchor: "end", size: 13, bold: true });
    missing.forEach((each, pass) => {
      const done = pass < passes.value;
      each.forEach((off, n) => {
        const high = (100 * off) / most;
        const [x, wide] = [8 + pass * room + (n * (room - 6)) / 2, (room - 8) / 2];
        figure.rect(x, FLOOR - high, wide, high, done ? COLORS[n] : "pale");
        const label = { color: done ? "ink" : "grey", anchor: "middle", size: 11 };
        if (off > 0.5 || done) figure.text(x + wide / 2, FLOOR - high - 4, touch.number(off), label);
      });
      figure.text(8 + pass * room + room / 2 - 3, FLOOR + 18, `${pass + 1}`, { color: "grey", anchor: "middle", size: 12 });
    });
    figure.line([{ x: 4, y: FLOOR }, { x: figure.width - 4, y: FLOOR }], "grey", 1);
  }

  function words(meant, reached) {
    const each = errors().map((error, n) => {
      const name = ["AB", "BC"][n];
      if (Math.abs(error) < 0.05) return `Rod ${name} is as long as it is meant to be: its bias is 0.`;
      const kind = error > 0 ? "too long" : "too short";
      return `Rod ${name} is ${Math.abs(error).toFixed(1)} px ${kind}: bias ${touch.number(meant[n])} px/s.`;
    });
    const many = passes.value === 1 ? "a pass" : `${passes.value} passes`;
    const [one, two] = reached.map((speed) => touch.number(speed));
    return `${each.join(" ")} After ${many} their ends part at ${one} and ${two} px/s; each pass of BC pulls at B, and so at AB.`;
  }
});
