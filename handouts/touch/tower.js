// Ten balls on top of each other in three engines: how far they sink, and what that costs.
"use strict";

touch.figure("tower", (figure) => {
  const { element, number } = touch;
  const ENGINES = { lesson: ["the lesson's", "red"], stable: ["stable", "blue"], pymunk: ["pymunk", "orange"] };
  const projector = new Projector("A tower of ten balls; dashed: where they should stay");
  const grid = element("div", { class: "films" });
  figure.picture.replaceWith(grid);
  grid.append(projector.canvas, figure.picture);
  let data = null, marks = [];

  const choice = (label, options, value) => {
    const select = element("select", {}, ...options.map(([key, words]) => element("option", { value: key }, words)));
    select.value = value;
    select.addEventListener("change", () => figure.redraw());
    figure.controls.append(element("label", {}, label, select));
    return select;
  };
  const engine = choice("engine", Object.entries(ENGINES).map(([key, [words]]) => [key, words]), "lesson");
  const passes = choice("passes", [2, 8, 30].map((count) => [count, `${count} passes`]), 8);
  const substeps = choice("substeps", [[1, "1 substep"], [4, "4 substeps"]], 1);
  const rate = choice("step", [30, 60, 120].map((count) => [count, `1/${count} s`]), 60);
  const play = element("button", { type: "button" }, "Play");
  play.addEventListener("click", () => {
    if (!data) return;
    if (projector.playing) projector.stop();
    else projector.play();
    play.textContent = projector.playing ? "Stop" : "Play";
  });
  figure.controls.append(play);
  figure.say("The films are being fetched.");
  films.whenSeen(figure.box, () =>
    films.load("tower", (found) => {
      data = found;
      figure.redraw();
      projector.go(projector.last);
    }),
  );

  const chosen = () => {
    const first = engine.value === "stable" ? 1 : passes.value; // it takes substeps in their place
    return `${engine.value}/${first}/${substeps.value}/${rate.value}`;
  };
  const choose = (mark) => {
    if (!mark) return;
    const [own, count, ...others] = mark.key.split("/");
    engine.value = own;
    if (own !== "stable") passes.value = count;
    [substeps.value, rate.value] = others;
  };
  figure.reading(
    (x, y, pressed) => {
      const far = (mark) => Math.hypot(mark.x - x, mark.y - y);
      if (pressed && marks.length) choose(marks.reduce((a, b) => (far(b) < far(a) ? b : a)));
    },
    (dx, dy) => {
      const key = chosen(), here = marks.find((mark) => mark.key === key);
      if (dy) return choose(marks.find((mark) => mark.engine === next(here.engine, dy)));
      const own = marks.filter((mark) => mark.engine === here.engine).sort((a, b) => a.x - b.x);
      choose(own[own.indexOf(here) + dx]);
    },
  );
  const next = (name, by) => Object.keys(ENGINES)[Object.keys(ENGINES).indexOf(name) + by];

  /** Error against cost of all that was recorded; what is chosen has a ring. */
  function chart() {
    const log = Math.log10;
    const [costs, sinks] = [[1e3, 1e4, 1e5], [0.1, 1, 10, 100]];
    const at = figure.axes({
      left: 44,
      top: 46,
      width: figure.width - 58,
      height: 200,
      x: [2.8, 5.7],
      y: [-1.1, 2.15],
      xs: costs.map(log),
      ys: sinks.map(log),
      xName: "contacts solved in a second",
      yName: "the top comes down by, px",
      xShow: (power) => (10 ** Math.round(power)).toLocaleString("en"),
      yShow: (power) => String(10 ** Math.round(power)),
    });
    Object.values(ENGINES).forEach(([words, color], n) => {
      figure.circle({ x: 12 + 106 * n, y: 12 }, 5, { fill: color });
      figure.text(22 + 106 * n, 17, words, { color, size: 13 });
    });
    marks = Object.entries(data.films).map(([key, { sink, work }]) => ({ key, engine: key.split("/")[0], ...at(log(work), log(sink)) }));
    for (const mark of marks) figure.circle(mark, 4.5, { fill: ENGINES[mark.engine][1], stroke: "paper", width: 1 });
    figure.circle(marks.find(({ key }) => key === chosen()), 9, { stroke: "ink" });
  }

  figure.height = 300;
  return () => {
    passes.disabled = engine.value === "stable";
    if (!data) return;
    const { sink, work, frames } = data.films[chosen()];
    const still = frames.map(([time]) => [time, 1, [], null, null, []]);
    const shots = { yours: [data.first, ...frames], expected: [data.first, ...still] };
    projector.show({ ...data.scene, ...shots, expected_looks: data.scene.looks });
    chart();
    figure.say(
      `The top comes down by ${number(sink, 1)} px in two seconds. ` +
        `Cost: ${work.toLocaleString("en")} times in a second a contact is solved` +
        (engine.value === "stable" ? ", once in each substep; it begins with the impulses of the last one." : "."),
    );
  };
});
