// How far each engine holds, in shares of what must hold, as it was measured.
"use strict";

touch.figure("hard-cases-limits", (figure) => {
  const COLORS = { lesson: "red", stable: "blue", pymunk: "orange", box2d: "green" };
  const ROW = 58; // px
  const TOP = 40; // px
  const shown = {};
  for (const engine of Object.keys(COLORS)) shown[engine] = figure.tick(engine, true);
  let read = { row: 0, engine: "lesson" }; // the mark whose value is told
  let marks = [];

  const words = (value) => Number(value.toPrecision(2)).toLocaleString("en", { maximumSignificantDigits: 2 });

  figure.reading(
    (x, y) => {
      const far = (mark) => Math.hypot(mark.x - x, mark.y - y);
      if (marks.length) read = marks.reduce((a, b) => (far(b) < far(a) ? b : a));
    },
    (dx, dy) => {
      const here = marks.find((mark) => mark.row === read.row && mark.engine === read.engine);
      if (!here) return;
      const line = dx
        ? marks.filter((mark) => mark.row === here.row).sort((a, b) => a.x - b.x)
        : marks.filter((mark) => mark.engine === here.engine);
      read = line[line.indexOf(here) + dx + dy] || here;
    },
  );

  function mark(engine, { x, y }) {
    const shapes = {
      stable: [[-6, -6], [6, -6], [6, 6], [-6, 6]],
      pymunk: [[0, -8], [8, 6], [-8, 6]],
      box2d: [[0, -8], [8, 0], [0, 8], [-8, 0]],
    };
    if (!shapes[engine]) return figure.circle({ x, y }, 6, { fill: COLORS[engine] });
    const points = shapes[engine].map(([dx, dy]) => `${x + dx},${y + dy}`).join(" ");
    figure.add("polygon", { points, style: `fill: var(--${COLORS[engine]})`, "data-engine": engine });
  }

  figure.height = TOP + ROW * measured.limits.length + 40;
  return () => {
    const [left, width] = [20, figure.width - 40];
    const bottom = TOP + ROW * measured.limits.length - 12;
    const at = (share) => left + (width * (Math.log10(share) + 2)) / 4;
    Object.keys(COLORS).forEach((engine, i) => {
      mark(engine, { x: left + 8 + (width * i) / 4, y: 18 });
      figure.text(left + 20 + (width * i) / 4, 23, engine, { color: COLORS[engine], size: 13 });
    });
    for (const share of [0.01, 0.1, 1, 10, 100]) {
      const color = share === 1 ? "ink" : "pale";
      figure.line([{ x: at(share), y: TOP }, { x: at(share), y: bottom }], color, share === 1 ? 2 : 1);
      figure.text(at(share), bottom + 18, String(share), { color: "grey", anchor: "middle", size: 12 });
    }
    figure.text(figure.width / 2, bottom + 38, "times what the stable engine must hold", { anchor: "middle", size: 13 });
    marks = [];
    measured.limits.forEach(({ title, far }, row) => {
      const y = TOP + ROW * row;
      figure.text(left + 6, y + 18, title, { size: figure.width < 420 ? 12 : 13 });
      for (const engine of Object.keys(COLORS)) {
        if (!shown[engine].checked) continue;
        const place = { row, engine, x: at(far[engine] / far["must hold"]), y: y + 36 };
        mark(engine, place);
        marks.push(place);
      }
    });
    const here = marks.find((each) => each.row === read.row && each.engine === read.engine) || marks[0];
    if (!here) return figure.say("All engines are switched off.");
    read = here;
    figure.circle(here, 12, { stroke: "ink" });
    const { title, far } = measured.limits[here.row];
    figure.say(`${title}: ${here.engine} ${words(far[here.engine])}, must hold: more than ${words(far["must hold"])}.`);
  };
});
