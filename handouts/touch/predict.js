// Three films, one of which is what will happen: choose one, and see.
"use strict";

touch.figure("predict", (figure) => {
  const { element } = touch;
  const grid = element("div", { class: "films" });
  figure.picture.replaceWith(grid);
  figure.controls.remove();
  let chosen = null;

  films.whenSeen(figure.box, () => films.load(figure.name, build));
  figure.say("The films are being fetched.");

  function build({ right, films: answers }) {
    figure.say("Which one will it be? Choose before you go on.");
    const buttons = answers.map(({ says, scene }, number) => {
      const letter = "ABC"[number];
      const projector = new Projector(`Film ${letter}`);
      const button = element("button", { type: "button" }, letter);
      const words = element("span");
      grid.append(element("div", { class: "film" }, projector.canvas, button, words));
      projector.show(scene);
      button.addEventListener("click", () => choose(number));
      return { letter, says, projector, button, words };
    });
    const [one, ...others] = buttons.map(({ projector }) => projector);
    const still = matchMedia("(prefers-reduced-motion: reduce)").matches;
    if (still) for (const each of [one, ...others]) each.go(each.last);
    else one.play(others);

    function choose(number) {
      const again = chosen !== null;
      chosen = number;
      buttons.forEach((each, at) => {
        each.words.textContent = each.says;
        each.button.classList.toggle("right", at === right);
        each.button.classList.toggle("wrong", at === number && at !== right);
        each.button.setAttribute("aria-pressed", at === number);
      });
      one.play(others);
      const { letter, says } = buttons[number];
      const yes = number === right ? `Yes, ${letter}.` : `No: ${letter} ${says}. It is ${buttons[right].letter}.`;
      figure.say(again ? `${letter} ${says}.` : yes);
    }
  }

  return () => {};
});
