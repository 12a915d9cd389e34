// A ball that slides comes to roll; the cone in which the floor's impulse may lie.
"use strict";

touch.figure("rolling", (figure) => {
  const friction = figure.slider("friction", {
    min: 0,
    max: 1.5,
    step: 0.05,
    value: 0.5,
    show: (value) => value.toFixed(2),
  });
  const first = figure.slider("first speed", { min: 60, max: 400, step: 10, value: 300, show: speedOf });
  const time = figure.slider("time", {
    min: 0,
    max: 0.6,
    step: 0.01,
    value: 0.1,
    show: (value) => `${value.toFixed(2)} s`,
  });
  figure.plays(time, "Roll");
  const RADIUS = 30; // px
  const FLOOR = 370; // px
  figure.height = 384;

  return () => {
    const now = laws.sliding(first.value, friction.value, time.value);
    const at = figure.axes({
      left: 46,
      top: 30,
      width: figure.width - 60,
      height: 150,
      x: [0, 0.6],
      y: [0, 400],
      xs: [0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6],
      ys: [0, 100, 200, 300, 400],
      xName: "time in s",
      yName: "px/s",
    });
    const times = Array.from({ length: 121 }, (_, n) => n / 200);
    const states = times.map((t) => laws.sliding(first.value, friction.value, t));
    figure.line(times.map((t, n) => at(t, states[n].speed)), "blue", 3);
    figure.line(times.map((t, n) => at(t, states[n].rim)), "orange", 3, "8 4");
    figure.line([at(time.value, 0), at(time.value, 400)], "grey", 1, "3 3");
    for (const [key, color] of [["speed", "blue"], ["rim", "orange"]]) figure.circle(at(time.value, now[key]), 5, { fill: color });
    const high = at(0, states[8].speed).y;
    figure.text(at(0.04, 0).x, high - 8, "speed", { color: "blue" });
    const end = { color: "orange", anchor: "end" };
    figure.text(at(0.59, 0).x, at(0, states.at(-1).rim).y + 20, "spin · radius", end);
    ball(now);
    figure.say(words(now));
  };

  /** The ball where it has come to, with the floor's impulse in its cone. */
  function ball({ speed, rim, rolls, way, turned }) {
    const c = { x: 76 + way, y: FLOOR - RADIUS };
    figure.line([{ x: 10, y: FLOOR }, { x: figure.width - 10, y: FLOOR }], "ink", 2);
    const foot = { x: c.x, y: FLOOR };
    const long = 62; // px, the normal part of the floor's impulse
    const wide = long * friction.value;
    const cone = [{ x: c.x - wide, y: FLOOR - long }, foot, { x: c.x + wide, y: FLOOR - long }];
    figure.line(cone, "green", 1.5, "5 4");
    figure.text(10, FLOOR - 92, "dashed: the cone, friction at most μ · jn", { color: "green", size: 13 });
    figure.circle(c, RADIUS, { fill: "blue", stroke: "blue", opacity: 0.15 });
    const angle = turned / RADIUS;
    for (const turn of [0, Math.PI / 2]) {
      const spoke = { x: RADIUS * Math.sin(angle + turn), y: RADIUS * Math.cos(angle + turn) };
      figure.line([{ x: c.x - spoke.x, y: c.y + spoke.y }, { x: c.x + spoke.x, y: c.y - spoke.y }], "blue", 1);
    }
    const edge = rolls || friction.value === 0 ? 0 : -wide;
    figure.arrow(foot, { x: c.x + edge, y: FLOOR - long }, "red", 4);
    if (speed > 1) figure.arrow(c, { x: c.x + 0.3 * speed, y: c.y }, "blue", 3);
    const slip = speed - rim;
    if (slip > 1) figure.arrow(foot, { x: c.x + 0.3 * slip, y: FLOOR }, "orange", 3);
  }

  function words({ speed, rim, rolls }) {
    if (rolls) return `It rolls at ${speedOf(speed)}, two thirds of ${speedOf(first.value)}: nothing slips, and the floor only carries it.`;
    if (friction.value === 0) return `On ice it keeps its ${speedOf(speed)} and never turns.`;
    return `It slips at ${speedOf(speed - rim)} (orange arrow). The floor's impulse (red) lies on the edge of its cone: it slows the ball and turns it.`;
  }
  function speedOf(value) {
    return `${value.toFixed(0)} px/s`;
  }
});
