"use strict";
// Names under the pointer: the nearest dot of all engines is told, and its curve is shown in all scenes.
for (const section of document.querySelectorAll(".prices")) {
  const data = section.querySelector("script.points"), select = section.querySelector("select");
  if (!data || !select) continue; // one's own page, or nobody to show
  const charts = JSON.parse(data.textContent); // [{ name, kind, places: [[x, y]], words: [] }] of each
  const figures = [...section.querySelectorAll("figure")];
  const groups = figures.map((figure) => {
    const found = new Map();
    for (const group of figure.querySelectorAll(".line")) {
      found.set(group.dataset.name, [...(found.get(group.dataset.name) || []), group]);
    }
    return found;
  });
  let shown = "";

  function show(name, place) {
    if (shown !== name) {
      section.querySelectorAll(".chosen").forEach((group) => group.classList.remove("chosen"));
      for (const found of groups) {
        for (const group of found.get(name) || []) {
          group.classList.add("chosen");
          if (group.matches(".engine")) group.parentNode.insertBefore(group, group.parentNode.querySelector(".front, .told"));
        }
      }
      shown = name;
      if ([...select.options].some((option) => option.value === name)) select.value = name;
    }
    figures.forEach((figure, number) => tell(figure, number, name, place && place.number === number ? place : null));
  }

  function tell(figure, number, name, place) {
    const lines = charts[number].filter((line) => line.name === name);
    const words = lines.flatMap((line) => line.words);
    figure.querySelector(".reads").textContent = lines.length ? `${name}: ${place ? place.words : words.join("; ")}` : "";
    const told = figure.querySelector(".told"), label = told.querySelector("text");
    const line = lines.find((each) => each.places.length);
    told.toggleAttribute("hidden", !line);
    if (!line) return;
    const [x, y] = place ? place.at : line.places[line.places.length - 1];
    told.querySelector("circle").setAttribute("cx", x);
    told.querySelector("circle").setAttribute("cy", y);
    label.textContent = name;
    const left = x > 230;
    label.setAttribute("text-anchor", left ? "end" : "start");
    label.setAttribute("x", left ? x - 9 : x + 9);
    label.setAttribute("y", y < 30 ? y + 24 : y - 9);
  }

  function nearest(svg, number, event) {
    const at = new DOMPoint(event.clientX, event.clientY).matrixTransform(svg.getScreenCTM().inverse());
    let best = null, least = 40; // px of the drawing: further off nobody is meant
    for (const line of charts[number]) {
      line.places.forEach(([x, y], which) => {
        const away = Math.hypot(x - at.x, y - at.y);
        if (away < least) {
          least = away;
          best = { number, name: line.name, at: [x, y], words: line.words[which] };
        }
      });
    }
    return best;
  }

  figures.forEach((figure, number) => {
    const svg = figure.querySelector("svg");
    for (const kind of ["pointermove", "pointerdown"]) {
      svg.addEventListener(kind, (event) => {
        const found = nearest(svg, number, event);
        if (found) show(found.name, found);
      });
    }
  });
  select.addEventListener("change", () => show(select.value, null));
  if (select.value) show(select.value, null); // a browser that goes back keeps what was chosen
}
