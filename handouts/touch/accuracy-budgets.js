// What error each engine reaches in 1, 4 and 16 ms of a frame, as it was measured.
"use strict";

touch.figure("accuracy-budgets", (figure) => {
  const { element } = touch;
  const FLOOR = 1e-9; // less than this is no error
  const PX = ["sink", "worst link"]; // errors in px; the others are shares of the exact value
  const ENGINES = {
    lesson: ["lesson", "red", ""],
    stable: ["stable", "blue", "8 4"],
    compiled: ["compiled", "ink", "2 4"],
    pymunk: ["pymunk", "orange", "12 4 2 4"],
    box2d: ["box2d", "green", "4 4"],
  };
  const names = [...new Set(measured.budgets.map((cell) => cell.scene))];
  const scene = element("select", {}, ...names.map((name) => element("option", {}, name)));
  scene.value = "tower of 20";
  scene.addEventListener("change", () => figure.redraw());
  figure.controls.append(element("label", {}, "scene", scene));
  const shown = {};
  for (const [engine, look] of Object.entries(ENGINES)) shown[engine] = figure.tick(look[0], true, ...look.slice(1));

  let read = { engine: "lesson", ms: 4 }; // the mark whose value is told
  let marks = []; // those drawn: a cell of what was measured, and its place

  /** An error as the tables write it. */
  function words(value) {
    if (value < FLOOR) return "less than 1e-9";
    return value < 1e-3 ? value.toExponential(1) : String(Number(value.toPrecision(2)));
  }

  figure.reading(
    (x, y) => {
      const far = (mark) => Math.hypot(mark.x - x, mark.y - y);
      if (marks.length) read = marks.reduce((a, b) => (far(b) < far(a) ? b : a)).cell;
    },
    (dx, dy) => {
      const here = marks.find((mark) => mark.cell === read);
      if (!here) return;
      const line = dx ? alike("engine", here, "x") : alike("ms", here, "y");
      read = (line[line.indexOf(here) + dx + dy] || here).cell;
    },
  );

  /** The marks of the same engine or time as this one, in the order of their places. */
  function alike(key, here, along) {
    const same = marks.filter((mark) => mark.cell[key] === here.cell[key]);
    return same.sort((a, b) => a[along] - b[along]);
  }

  function tell() {
    const mark = marks.find(({ cell }) => cell.engine === read.engine && cell.ms === read.ms) || marks[0];
    if (!mark) return figure.say("All engines are switched off.");
    read = mark.cell;
    const { engine, error, ms, least, most } = read;
    const unit = PX.includes(error) ? " px" : " of the exact value";
    const range = words(least) === words(most) ? "" : `, up to ${words(most)} in other repeats`;
    figure.circle(mark, 10, { stroke: "ink" });
    figure.say(`${ENGINES[engine][0]} within ${ms} ms of a frame: ${error} off by ${words(least)}${unit}${range}.`);
  }

  figure.height = 360;
  return () => {
    const cells = measured.budgets.filter((cell) => cell.scene === scene.value);
    const times = [...new Set(cells.map((cell) => cell.ms))].sort((a, b) => a - b);
    const log = (value) => Math.log10(Math.max(value, FLOOR));
    const top = Math.ceil(Math.max(...cells.map((cell) => log(cell.most)), -8));
    const at = figure.axes({
      left: 62,
      top: 34,
      width: figure.width - 150,
      height: 270,
      x: [-0.2, times.length - 0.95],
      y: [-9, top],
      xs: times.map((_, i) => i),
      ys: Array.from({ length: top + 10 }, (_, i) => i - 9),
      xName: "time in each frame",
      yName: `${cells[0].error}, ${PX.includes(cells[0].error) ? "px" : "share of the exact value"}`,
      xShow: (i) => `${times[i]} ms`,
      yShow: (power) => (power === -9 ? "\u2264 1e-9" : power < -2 ? `1e${power}` : String(10 ** power)),
    });
    marks = [];
    const labels = [];
    for (const [engine, [name, color, dash]] of Object.entries(ENGINES)) {
      const own = cells.filter((cell) => cell.engine === engine).sort((a, b) => a.ms - b.ms);
      if (!shown[engine].checked || !own.length) continue;
      const places = own.map((cell) => ({ cell, ...at(times.indexOf(cell.ms), log(cell.least)) }));
      for (const { cell, x, y } of places) figure.line([{ x, y }, { x, y: at(0, log(cell.most)).y }], color, 5);
      figure.line(places, color, 2, dash);
      for (const place of places) figure.circle(place, 5, { fill: color });
      marks.push(...places);
      labels.push({ name, color, x: places.at(-1).x + 14, y: places.at(-1).y + 5 });
    }
    labels.sort((a, b) => b.y - a.y); // from below: a label that another one is on goes up
    labels.forEach((label, i) => {
      if (i) label.y = Math.min(label.y, labels[i - 1].y - 16);
      figure.text(label.x, label.y, label.name, { color: label.color });
    });
    tell();
  };
});
