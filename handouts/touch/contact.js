// A circle over a box: closest point, normal and depth, wherever its centre is.
"use strict";

touch.figure("contact", (figure) => {
  const radius = figure.slider("radius", { min: 20, max: 90, step: 1, value: 60, show: px });
  const centre = { x: -40, y: -98 }; // px, from the middle of the box
  figure.height = 300;
  const box = () => ({ x: figure.width / 2, y: 195, hx: Math.min(170, figure.width * 0.3), hy: 55 });
  const place = () => ({ x: box().x + centre.x, y: box().y + centre.y });
  figure.handle("The circle", place, (x, y) => {
    centre.x = Math.min(Math.max(x, 0), figure.width) - box().x;
    centre.y = Math.min(Math.max(y, 0), figure.height) - box().y;
  });

  return () => {
    const b = box();
    const c = { ...place(), r: radius.value };
    const { distance, out, depth, point } = laws.circleBox(c, b);
    const inside = distance <= 0;
    figure.rect(b.x - b.hx, b.y - b.hy, 2 * b.hx, 2 * b.hy, "pale", "grey");
    figure.circle(c, c.r, { fill: depth > 0 ? "blue" : "none", stroke: "blue", opacity: 0.15 });
    figure.line([c, point], "grey", 1.5, "4 4");
    if (depth > 0) {
      const aside = { x: point.x + 18 * out.y, y: point.y - 18 * out.x };
      const rim = { x: aside.x - depth * out.x, y: aside.y - depth * out.y };
      figure.line([aside, rim], "orange", 5);
      figure.line([point, aside], "orange", 1, "3 3");
      const tip = { x: c.x - 62 * out.x, y: c.y - 62 * out.y };
      figure.arrow(c, tip, "green", 3);
      figure.text(tip.x + 10, tip.y + 14, "normal", { color: "green" });
    }
    figure.circle(point, 5, { fill: "red" });
    figure.text(8, 20, inside ? "Centre inside" : "Centre outside", { bold: true });
    figure.say(told(inside, distance, c.r, depth, out));
  };

  function told(inside, distance, r, depth, out) {
    if (depth <= 0) return `No contact: the closest point is ${px(distance)} away, the radius ${px(r)}.`;
    const normal = `The normal leads to the box: (${touch.number(-out.x, 2)}, ${touch.number(-out.y, 2)}).`;
    if (!inside) return `Depth = radius − distance = ${px(r)} − ${px(distance)} = ${px(depth)}. ${normal}`;
    const face = out.x ? (out.x < 0 ? "left" : "right") : out.y < 0 ? "top" : "bottom";
    return `The ${face} face is nearest. Depth = radius + gap = ${px(r)} + ${px(-distance)} = ${px(depth)}. ${normal}`;
  }
  function px(value) {
    return `${value.toFixed(Number.isInteger(value) ? 0 : 1)} px`;
  }
});
