// The accumulator: each frame adds its time, and each step takes 1/120 s away.
"use strict";

touch.figure("accumulator", (figure) => {
  const length = figure.slider("a frame takes", {
    min: 4,
    max: 250,
    step: 1,
    value: 20,
    show: (ms) => `${ms} ms, ${Math.round(1000 / ms)} a second`,
  });
  figure.height = 270;

  return () => {
    const narrow = figure.width < 560;
    const many = narrow ? 6 : 10;
    const left = narrow ? 80 : 96;
    const room = (figure.width - left) / many;
    const ms = (value) => (value / Math.max(length.value, 80)) * (room - 8);
    for (const [words, y] of [["frame", 30], ["counted", 66], ["steps", 130], ["waiting", 226]]) {
      figure.text(4, y, words, { bold: true });
    }
    const frames = laws.runFrames(length.value, many);
    frames.forEach(({ counted, steps, waiting }, n) => {
      const x = left + n * room;
      figure.rect(x, 16, ms(length.value), 20, "pale", "grey");
      figure.rect(x, 52, ms(length.value), 20, "none", "red");
      figure.rect(x, 52, ms(counted), 20, "blue");
      for (let k = 0; k < steps; k += 1) figure.rect(x, 174 - 11 * k, room - 14, 8, "blue");
      figure.text(x, 201, `${steps}`, { color: "grey", size: 12 });
      figure.rect(x, 214, ((room - 14) * waiting) / (1000 * laws.STEP), 16, "orange");
      figure.text(x, 248, `${waiting.toFixed(1)}`, { color: "grey", size: 12 });
    });
    const lost = length.value - frames[0].counted;
    const share = (100 * frames[0].counted) / length.value;
    const mean = frames[0].counted / (1000 * laws.STEP);
    const steps = `A frame pays for ${mean.toFixed(2)} steps of 8.33 ms on average.`;
    figure.say(
      lost > 0
        ? `${steps} The cap is 8: of each frame ${lost.toFixed(0)} ms are given up (red), and the scene runs at ${share.toFixed(0)} % of its speed.`
        : `${steps} What is too little for a step waits (orange, ms). Nothing is lost: the scene runs at its own speed.`,
    );
  };
});
