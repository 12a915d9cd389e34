// Ten balls on top of each other in three engines: how far they sink, and what that costs.
"use strict";

touch.figure("tower", (figure) => {
  const { element, number } = touch;
  const projector = new Projector("A tower of ten balls; dashed: where they should stay");
  figure.picture.replaceWith(element("div", { class: "films" }, projector.canvas));
  let data = null, still = [];

  const choice = (label, options, value) => {
    const select = element("select", {}, ...options.map(([key, words]) => element("option", { value: key }, words)));
    select.value = value;
    select.addEventListener("change", () => figure.redraw());
    figure.controls.append(element("label", {}, label, select));
    return select;
  };
  const engine = choice("engine", [["lesson", "the lesson's"], ["stable", "stable"], ["pymunk", "pymunk"]], "lesson");
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

  function film() {
    const first = engine.value === "stable" ? 1 : passes.value;
    return data.films[`${engine.value}/${first}/${substeps.value}/${rate.value}`];
  }

  return () => {
    passes.disabled = engine.value === "stable"; // it takes substeps in their place
    if (!data) return;
    const { sink, work, frames } = film();
    still = frames.map(([time]) => [time, 1, [], null, null, []]);
    const shots = { yours: [data.first, ...frames], expected: [data.first, ...still] };
    projector.show({ ...data.scene, ...shots, expected_looks: data.scene.looks });
    figure.say(
      `The top comes down by ${number(sink, 1)} px in two seconds. ` +
        `Cost: ${work.toLocaleString("en")} times in a second a contact is solved` +
        (engine.value === "stable" ? ", once in each substep; it begins with the impulses of the last one." : "."),
    );
  };
});
