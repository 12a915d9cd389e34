// A rod that is too long or too short: its error, the speed at which that shrinks, and a step.
"use strict";

touch.figure("rod", (figure) => {
  const light = figure.slider("mass of A", {
    min: 0,
    max: 8,
    step: 1,
    value: 1,
    show: (mass) => (mass ? `${mass} kg` : "static"),
  });
  const heavy = figure.slider("mass of B", { min: 1, max: 8, step: 1, value: 3, show: (m) => `${m} kg` });
  const LENGTH = 120; // px
  const ends = { a: -75, b: 105 }; // px, along the rod, from the middle of the drawing
  figure.button("One step", () => {
    const { speedA, speedB } = solved();
    ends.a += speedA * laws.STEP;
    ends.b += speedB * laws.STEP;
  });
  const middle = () => ({ x: figure.width / 2, y: 90 });
  figure.handle("B", () => ({ x: middle().x + ends.b, y: middle().y }), (x) => {
    const room = middle().x - 30;
    ends.b = Math.min(Math.max(x - middle().x, ends.a + 40), room);
  });
  figure.height = 190;

  function solved() {
    const error = ends.b - ends.a - LENGTH;
    const masses = { massA: light.value, massB: heavy.value };
    return { error, ...laws.rodSolved({ ...masses, error, speedA: 0, speedB: 0, dt: laws.STEP }) };
  }

  return () => {
    const { error, parting, speedA, speedB } = solved();
    const { x, y } = middle();
    const [a, b] = [ends.a, ends.b].map((along) => ({ x: x + along, y }));
    figure.line([a, b], "grey", 4);
    const meant = a.x + LENGTH;
    figure.line([{ x: a.x, y: y + 44 }, { x: meant, y: y + 44 }], "green", 3);
    figure.text(a.x, y + 62, `meant: ${LENGTH} px`, { color: "green" });
    if (Math.abs(error) >= 0.5) figure.line([{ x: meant, y: y + 44 }, { x: b.x, y: y + 44 }], "red", 3);
    ball(a, light.value, "A");
    ball(b, heavy.value, "B");
    push(a, speedA);
    push(b, speedB);
    const kind = error > 0 ? "too long" : "too short";
    figure.say(
      Math.abs(error) < 0.05
        ? "The rod is as long as it is meant to be: bias is 0, and nothing is pushed."
        : `The rod is ${Math.abs(error).toFixed(1)} px ${kind}. Bias: its ends ${parting < 0 ? "close" : "part"} at ${Math.abs(parting).toFixed(0)} px/s, ` +
          `so that a fifth of the error goes in a step. A gets ${touch.number(speedA)} px/s, B ${touch.number(speedB)} px/s: the lighter end takes more of it.`,
    );
  };

  function ball(c, mass, name) {
    if (mass) figure.circle(c, 10 + 3 * mass, { fill: "blue", stroke: "blue", opacity: 0.2 });
    else figure.rect(c.x - 12, c.y - 12, 24, 24, "grey");
    figure.text(c.x, c.y - 14 - 3 * mass, name, { anchor: "middle", bold: true });
  }

  function push(c, speed) {
    const y = c.y + 24;
    figure.arrow({ x: c.x, y }, { x: c.x + 0.08 * speed, y }, "red", 3);
  }
});
