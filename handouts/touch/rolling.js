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
  figure.height = 430;

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
    const high = at(0, states[8].speed).y;
    figure.text(at(0.04, 0).x, high - 8, "speed", { color: "blue" });
    const end = { color: "orange", anchor: "end" };
    figure.text(at(0.59, 0).x, at(0, states.at(-1).rim).y + 20, "spin · radius", end);
    ball(now);
    figure.say(words(now));
  };

  function ball({ speed, rim, rolls }) {
    const floor = 400;
    const c = { x: figure.width * 0.4, y: floor - 40 };
    figure.line([{ x: 10, y: floor }, { x: figure.width - 10, y: floor }], "ink", 2);
    const foot = { x: c.x, y: floor };
    const long = 100; // px, the normal part of the floor's impulse
    const wide = long * friction.value;
    const cone = [{ x: c.x - wide, y: floor - long }, foot, { x: c.x + wide, y: floor - long }];
    figure.line(cone, "green", 1.5, "5 4");
    const words = "cone: friction at most μ · jn";
    figure.text(figure.width - 10, floor - long - 10, words, { color: "green", anchor: "end" });
    figure.circle(c, 40, { fill: "blue", stroke: "blue", opacity: 0.15 });
    const edge = rolls || friction.value === 0 ? 0 : -wide;
    figure.arrow(foot, { x: c.x + edge, y: floor - long }, "red", 4);
    if (speed > 1) figure.arrow(c, { x: c.x + 0.4 * speed, y: c.y }, "blue", 3);
    const slip = speed - rim;
    if (slip > 1) figure.arrow(foot, { x: c.x + 0.4 * slip, y: floor }, "orange", 3);
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
