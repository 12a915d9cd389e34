// Damping by a share per step, and by a rate per second.
"use strict";

touch.figure("damping", (figure) => {
  const hertz = figure.slider("steps a second", { min: 20, max: 480, step: 20, value: 120 });
  const rate = figure.slider("rate", {
    min: 0,
    max: 3,
    step: 0.05,
    value: 0.6,
    show: (value) => `${value.toFixed(2)} per second`,
  });
  const KEPT = 0.99; // in every step
  figure.height = 300;

  return () => {
    const at = figure.axes({
      left: 52,
      top: 34,
      width: figure.width - 150,
      height: 210,
      x: [0, 1],
      y: [0, 1],
      xs: [0, 0.25, 0.5, 0.75, 1],
      ys: [0, 0.25, 0.5, 0.75, 1],
      xName: "time in s",
      yName: "what is left of a speed",
      yShow: (share) => `${100 * share} %`,
    });
    const steps = Array.from({ length: hertz.value + 1 }, (_, n) => n);
    const perStep = steps.map((n) => at(n / hertz.value, KEPT ** n));
    const perSecond = steps.map((n) => at(n / hertz.value, laws.damped(rate.value, n / hertz.value)));
    figure.line(perStep, "red", 3, "9 5");
    figure.line(perSecond, "blue", 3);
    const [red, blue] = [perStep.at(-1), perSecond.at(-1)];
    const apart = Math.abs(red.y - blue.y) < 16 ? 12 * Math.sign(red.y - blue.y || 1) : 0;
    figure.text(red.x + 6, red.y + 5 + apart, "0.99 a step", { color: "red" });
    figure.text(blue.x + 6, blue.y + 5 - apart, "a rate", { color: "blue" });
    const left = 100 * KEPT ** hertz.value;
    const kept = 100 * laws.damped(rate.value, 1);
    figure.say(
      `With ${hertz.value} steps a second, 0.99 in every step leaves ${left.toFixed(1)} % after a second. ` +
        `The rate leaves ${kept.toFixed(1)} %, however many steps there are.`,
    );
  };
});
