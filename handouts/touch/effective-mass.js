// An impulse on a disc: where it acts decides how far the disc gives way, by moving and by turning.
"use strict";

touch.figure("effective-mass", (figure) => {
  const mass = figure.slider("mass", { min: 1, max: 8, step: 1, value: 2, show: (m) => `${m} kg` });
  const slope = figure.slider("impulse turned by", {
    min: -60,
    max: 60,
    step: 5,
    value: 0,
    show: (degrees) => `${degrees}°`,
  });
  const time = figure.slider("time", {
    min: 0,
    max: 1.5,
    step: 0.01,
    value: 0.9,
    show: (value) => `${value.toFixed(2)} s later`,
  });
  figure.plays(time, "Push");
  const RADIUS = 80; // px
  const IMPULSE = 100; // kg px/s
  const arm = { x: -28, y: -66 }; // px, from the centre to the point of impact
  const centre = () => ({ x: Math.max(figure.width * 0.3, 110), y: 130 });
  figure.height = 330;
  figure.handle("The point of impact", () => plus(centre(), arm), (x, y) => {
    const { x: left, y: top } = centre();
    const share = Math.min(1, RADIUS / Math.max(Math.hypot(x - left, y - top), 1e-9));
    [arm.x, arm.y] = [share * (x - left), share * (y - top)];
  });

  return () => {
    const angle = (slope.value * Math.PI) / 180;
    const axis = { x: Math.cos(angle), y: Math.sin(angle) };
    const disc = { mass: mass.value, radius: RADIUS };
    const { moving, turning, lever } = laws.giving(disc, arm, angle);
    const [c, point] = [centre(), plus(centre(), arm)];
    const speed = IMPULSE * moving; // px/s
    const spin = (IMPULSE * 2 * lever) / (mass.value * RADIUS ** 2); // rad/s
    const later = plus(c, axis, speed * time.value);
    figure.circle(later, RADIUS, { fill: "grey", stroke: "grey", width: 1, opacity: 0.1 });
    spoke(later, spin * time.value, "grey");
    figure.circle(c, RADIUS, { fill: "blue", stroke: "blue", opacity: 0.12 });
    spoke(c, 0, "blue");
    figure.circle(c, 3, { fill: "ink" });
    figure.line([c, point], "orange", 3);
    const beyond = { color: "orange", anchor: arm.x < 0 ? "end" : "start" };
    figure.text(c.x + arm.x / 2 + (arm.x < 0 ? -8 : 8), c.y + arm.y / 2 + 12, "arm r", beyond);
    const beside = plus(point, axis, -(arm.x * axis.x + arm.y * axis.y));
    if (Math.abs(lever) > 2) figure.line([c, beside], "green", 2, "4 3");
    figure.line([plus(beside, axis, -90), plus(beside, axis, 190)], "grey", 1, "2 4");
    const tail = plus(point, axis, -70);
    figure.arrow(tail, plus(point, axis, -9), "red", 4);
    figure.text(Math.max(tail.x, 4), Math.max(tail.y - 8, 14), "impulse", { color: "red" });
    bars(moving, turning);
    figure.say(
      `r × n = ${touch.number(lever)} px (dashed). An impulse of 1 changes the speed of the point by ` +
        `1/m + (r × n)²/I = ${moving.toFixed(3)} + ${turning.toFixed(3)} = ${(moving + turning).toFixed(3)} per kg. ` +
        `An impulse of ${IMPULSE} moves the disc at ${speed.toFixed(0)} px/s and turns it at ${touch.number(spin, 2)} rad/s.`,
    );
  };

  function spoke(c, angle, color) {
    const tip = { x: RADIUS * Math.sin(angle), y: -RADIUS * Math.cos(angle) };
    figure.line([c, plus(c, tip)], color, 1.5);
  }

  /** How the disc gives way: 1/m, and what the spin adds. */
  function bars(moving, turning) {
    const [left, room] = [92, figure.width - 160];
    const scale = room / 3; // a disc of 1 kg that is hit at its rim gives way by 3 per kg
    [["moving", moving, "blue"], ["turning", turning, "green"]].forEach(([name, value, color], n) => {
      const y = 262 + 30 * n;
      figure.text(6, y + 15, name, { bold: true });
      figure.rect(left, y, scale * value, 20, color);
      figure.text(left + scale * value + 6, y + 15, value.toFixed(3), { color: "grey" });
    });
  }

  function plus(place, way, times = 1) {
    return { x: place.x + times * way.x, y: place.y + times * way.y };
  }
});
