// The curves of accuracy.md as they were measured: values under the pointer, curves on and off.
"use strict";

for (const [name, chart] of Object.entries(measured.charts)) {
  touch.figure(name, (figure) => {
    const { element } = touch;
    const FRAME = 1000 / 60; // ms
    const LOOKS = {
      lesson: ["red", ""],
      stable: ["blue", "8 4"],
      compiled: ["ink", "2 4"],
      pymunk: ["orange", "12 4 2 4"],
      box2d: ["green", "4 4"],
      explicit_euler: ["red", ""],
      semi_implicit_euler: ["blue", "8 4"],
      velocity_verlet: ["green", "12 4 2 4"],
      rk4: ["orange", "2 4"],
      passes: ["red", ""],
      step: ["blue", "8 4"],
      "shared substeps": ["green", "2 4"],
      "as it is": ["ink", "0 1000"],
    };
    const axis = element("select", {}, ...chart.panels.map(({ x }) => element("option", {}, x)));
    axis.addEventListener("change", () => figure.redraw());
    if (chart.panels.length > 1) figure.controls.append(element("label", {}, "along", axis));
    const shown = {};
    for (const { look, name: curve } of chart.panels[0].curves) {
      shown[look] = figure.tick(curve, true, ...LOOKS[look]);
    }
    let read = { look: chart.panels[0].curves[0].look, x: 0 }; // the mark whose value is told
    let marks = []; // those drawn, each a value and its place

    /** A number in three digits. */
    function words(value) {
      if (value !== 0 && (value < 1e-3 || value >= 1e6)) return Number(value.toPrecision(2)).toExponential().replace("+", "");
      return Number(value.toPrecision(3)).toLocaleString("en", { maximumSignificantDigits: 3 });
    }

    /** "sink (px)" as a name and a unit. */
    function parts(label) {
      const [, what, unit] = label.match(/^(.*?)(?: \((\S+)\))?$/);
      return [what, unit && unit !== "share" ? ` ${unit}` : ""];
    }

    figure.reading(
      (x, y) => {
        const far = (mark) => Math.hypot(mark.at.x - x, mark.at.y - y);
        if (marks.length) read = marks.reduce((a, b) => (far(b) < far(a) ? b : a));
      },
      (dx, dy) => {
        const here = marks.indexOf(read);
        if (dx) {
          const along = marks.filter(({ look }) => look === read.look).sort((a, b) => a.x - b.x);
          read = along[along.indexOf(read) + dx] || read;
        } else if (here >= 0) {
          const looks = [...new Set(marks.map(({ look }) => look))];
          const next = looks[looks.indexOf(read.look) + dy];
          const near = (a, b) => (Math.abs(b.at.x - read.at.x) < Math.abs(a.at.x - read.at.x) ? b : a);
          if (next) read = marks.filter(({ look }) => look === next).reduce(near);
        }
      },
    );

    function tell(panel) {
      read = marks.find(({ look, x, y }) => look === read.look && x === read.x && y === read.y) || marks[0];
      if (!read) return figure.say("All curves are switched off.");
      const [across, acrossUnit] = parts(panel.x);
      const [up, unit] = parts(chart.y);
      const value = {
        high: `above ${words(chart.ends[1])}${unit}, or given up`,
        low: `below ${words(chart.ends[0])}${unit}`,
      }[read.edge];
      figure.circle(read.at, 10, { stroke: "ink" });
      figure.say(
        `${read.name}: ${up} ${value || words(read.y) + unit}; ${across}: ${words(read.x)}${acrossUnit}.`,
      );
    }

    figure.height = 380;
    return () => {
      const panel = chart.panels[Math.max(axis.selectedIndex, 0)];
      const [bottom, top] = chart.ends;
      const every = panel.curves.flatMap(({ points, high, low }) => [...points.map(([x]) => x), ...high, ...low]);
      const reach = [Math.min(...every) / 1.15, Math.max(...every) * 1.15].map(Math.log10);
      const [low, high] = [bottom / 1.3, top * 1.3].map(Math.log10);
      const at = figure.axes({
        left: 62,
        top: 34,
        width: figure.width - 84,
        height: 290,
        x: reach,
        y: [low, high],
        xs: ticks(...reach),
        ys: ticks(low, high, Math.ceil((high - low) / 9)),
        xName: panel.x,
        yName: chart.y,
        xShow: (power) => words(10 ** power),
        yShow: (power) => words(10 ** power),
      });
      const frame = Math.log10(FRAME);
      if (chart.frame === "x" && panel === chart.panels[0] && reach[0] < frame && frame < reach[1]) {
        figure.line([at(frame, low), at(frame, high)], "grey", 1);
        figure.text(at(frame, 0).x - 5, 50, "a frame, 16.7 ms", { color: "grey", anchor: "end", size: 12 });
      }
      marks = [];
      for (const { look, name: curve, points, high: given, low: less } of panel.curves) {
        if (!shown[look].checked) continue;
        const [color, dash] = LOOKS[look];
        const place = (x, y) => at(Math.log10(x), Math.log10(y));
        const own = points.map(([x, y]) => ({ x, y, at: place(x, y) }));
        figure.line(own.map((mark) => mark.at), color, 2, dash);
        const size = look === "as it is" ? 8 : 4.5;
        for (const mark of own) figure.circle(mark.at, size, { fill: color, stroke: "paper", width: 1 });
        const edges = [...given.map((x) => ({ x, edge: "high", at: place(x, top) }))];
        edges.push(...less.map((x) => ({ x, edge: "low", at: place(x, bottom) })));
        for (const { edge, at: spot } of edges) figure.text(spot.x, spot.y + 6, edge === "high" ? "×" : "▿", { color, anchor: "middle", size: 20 });
        marks.push(...[...own, ...edges].map((mark) => ({ ...mark, look, name: curve })));
      }
      tell(panel);
    };
  });
}

/** The powers of ten in a reach, at most every so many; 2 and 5 times them where there are few. */
function ticks(low, high, every = 1) {
  const found = [];
  const factors = high - low < 1.5 ? [1, 2, 5] : [1];
  for (let power = Math.floor(low); power <= high; power++) {
    if (power % every) continue;
    for (const factor of factors) found.push(power + Math.log10(factor));
  }
  return found.filter((value) => low <= value && value <= high);
}
