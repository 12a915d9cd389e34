// Four integrators on a spring: the swing in the plane of place and speed, and the energy over time.
"use strict";

touch.figure("integrators", (figure) => {
  const COLORS = {
    explicit_euler: "red",
    semi_implicit_euler: "blue",
    velocity_verlet: "orange",
    rk4: "green",
  };
  const TITLES = ["explicit Euler", "semi-implicit Euler", "velocity Verlet", "RK4"];
  const DASHES = ["2 3", "", "8 4", "12 3 2 3"]; // so that they differ without colour, too
  const placeOf = (name) => Object.keys(COLORS).indexOf(name);
  const steps = figure.slider("steps a swing", { min: 4, max: 60, step: 1, value: 12 });
  const swings = figure.slider("swings", { min: 1, max: 300, step: 1, value: 3 });
  const shown = Object.entries(COLORS).map(([name, color], n) => [
    name,
    figure.tick(TITLES[n], name !== "velocity_verlet", color, DASHES[n]),
  ]);
  const LAST = 120; // steps that are drawn in the plane

  return () => {
    const wide = figure.width >= 620;
    const size = wide ? Math.min(figure.width * 0.38, 300) : Math.min(figure.width - 20, 300);
    figure.height = wide ? size + 62 : 2 * size + 90;
    const middle = { x: wide ? size / 2 + 10 : figure.width / 2, y: size / 2 + 26 };
    const unit = size / 3.4; // px for the first amplitude
    figure.text(middle.x, 16, "to the right place, upwards speed", { anchor: "middle", size: 13 });
    figure.circle(middle, unit, { stroke: "grey", width: 1 });
    const chosen = shown.filter(([, tick]) => tick.checked).map(([name]) => name);
    const runs = chosen.map((name) => ({ name, ...run(name, steps.value, swings.value) }));
    for (const { name, places } of runs) {
      const style = [COLORS[name], 2, DASHES[placeOf(name)]];
      const far = size / 2 / unit;
      const inside = places.slice(-LAST).filter(([x, s]) => Math.max(Math.abs(x), Math.abs(s)) < far);
      const drawn = inside.map(([x, s]) => ({ x: middle.x + unit * x, y: middle.y - unit * s }));
      figure.line(drawn, ...style);
      for (const place of drawn) figure.circle(place, 2.5, { fill: COLORS[name] });
    }
    energies(runs, wide ? size + 90 : 64, wide ? 40 : size + 76, wide ? size - 40 : size - 60);
    figure.say(runs.map(words).join(" ") || "Tick a method.");
  };

  /** Places and energies after each step; energies as shares of the first. */
  function run(name, perSwing, many) {
    const [a, b, c, d] = laws.integrators[name]((2 * Math.PI) / perSwing);
    let [x, s] = [1, 0];
    const places = [[x, s]];
    const energy = [1];
    for (let n = 0; n < perSwing * many; n += 1) {
      [x, s] = [a * x + b * s, c * x + d * s];
      places.push([x, s]);
      energy.push(x * x + s * s);
    }
    return { places, energy };
  }

  function energies(runs, left, top, height) {
    const width = figure.width - left - 12;
    const at = figure.axes({
      left, top, width, height,
      x: [0, swings.value],
      y: [0, 2],
      xs: [0, swings.value],
      ys: [0, 0.5, 1, 1.5, 2],
      xName: "swings",
      yName: "energy, as a share of the first",
    }); // prettier-ignore
    for (const { name, energy } of runs) {
      const every = Math.max(1, Math.floor(energy.length / (2 * width)));
      const points = energy
        .map((value, n) => ({ value, n }))
        .filter(({ value, n }) => n % every === 0 && value < 2.05)
        .map(({ value, n }) => at(n / steps.value, value));
      figure.line(points, COLORS[name], 2, DASHES[placeOf(name)]);
    }
  }

  function words({ name, energy }) {
    const title = TITLES[placeOf(name)];
    const [low, high, last] = [Math.min(...energy), Math.max(...energy), energy.at(-1)];
    if (high > 100) return `${title}: the energy grows without bound.`;
    if (name === "rk4" || name === "explicit_euler") return `${title}: drifts, to ${percent(last)} so far.`;
    return `${title}: stays between ${percent(low)} and ${percent(high)}.`;
  }
  function percent(share) {
    const hardly = share !== 1 && Math.abs(share - 1) < 0.0005;
    return `${(100 * share).toFixed(hardly ? 3 : 1)} %`;
  }
});
