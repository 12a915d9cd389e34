// What the figures compute. A test compares it with the grader's own closed forms.
//
// None of it is written as a TODO asks for it: distances come from a distance field, ends of a rod
// from their common momentum, integrators from the matrix of a step on a spring.
"use strict";

const laws = {
  STEP: 1 / 120, // s
  MAX_STEPS: 8, // in a frame
  BETA: 0.2, // share of an error put right in one step
  GRAVITY: 980, // px/s²

  /**
   * A circle {x, y, r} and a box {x, y, hx, hy}: signed distance from the box to the centre, below 0
   * inside; the unit vector out of the box there; depth of the overlap, which may be below 0; the
   * point of the box's rim that is meant. All in px.
   */
  circleBox({ x, y, r }, box) {
    const side = { x: x < box.x ? -1 : 1, y: y < box.y ? -1 : 1 };
    const past = { x: Math.abs(x - box.x) - box.hx, y: Math.abs(y - box.y) - box.hy };
    const beyond = { x: Math.max(past.x, 0), y: Math.max(past.y, 0) };
    const outside = Math.hypot(beyond.x, beyond.y);
    const across = past.x > past.y; // of the faces, left or right is nearer than top or bottom
    const inward = { x: across ? 1 : 0, y: across ? 0 : 1 };
    const way = outside > 0 ? { x: beyond.x / outside, y: beyond.y / outside } : inward;
    const out = { x: way.x * side.x, y: way.y * side.y };
    const distance = outside > 0 ? outside : Math.max(past.x, past.y);
    const point = { x: x - distance * out.x, y: y - distance * out.y };
    return { distance, out, depth: r - distance, point };
  },

  /** The share of a speed that is left after so many seconds at a rate per second. */
  damped: (rate, seconds) => Math.exp(-rate * seconds),

  /** Frames of a length in ms, each counted up to the cap: steps they pay for, ms that wait. */
  runFrames(frame, frames) {
    const step = 1000 * laws.STEP;
    const counted = Math.min(frame, laws.MAX_STEPS * step);
    const paid = (n) => Math.floor((n * counted) / step + 1e-9);
    return Array.from({ length: frames }, (_, n) => ({
      counted,
      steps: paid(n + 1) - paid(n),
      waiting: Math.max((n + 1) * counted - paid(n + 1) * step, 0),
    }));
  },

  /** How a disc {mass, radius} gives way to an impulse of 1 at an arm {x, y} along an angle, 1/kg. */
  giving({ mass, radius }, arm, angle) {
    const lever = Math.hypot(arm.x, arm.y) * Math.sin(angle - Math.atan2(arm.y, arm.x)); // px
    return { moving: 1 / mass, turning: (2 * lever ** 2) / (mass * radius ** 2), lever };
  },

  /**
   * The speeds along a rod after a pass, positive from A to B: the ends part by BETA of the error in
   * each step, and keep their momentum together. A mass of 0 is a static end's.
   */
  rodSolved({ massA, massB, error, speedA, speedB, dt }) {
    const parting = (-error * laws.BETA) / dt; // px/s
    if (!massA) return { parting, speedA, speedB: speedA + parting };
    if (!massB) return { parting, speedA: speedB - parting, speedB };
    const common = (massA * speedA + massB * speedB) / (massA + massB);
    const shareA = massB / (massA + massB);
    return {
      parting,
      speedA: common - shareA * parting,
      speedB: common + (1 - shareA) * parting,
    };
  },

  /**
   * Two rods A-B and B-C, solved pass by pass from rest: the speeds at which their ends are meant to
   * part, those at which they do after each pass, and the speeds of A, B and C in the end.
   */
  chainSolved({ masses, errors, passes, dt }) {
    let [a, b, c] = [0, 0, 0]; // px/s
    const meant = errors.map((error) => (-error * laws.BETA) / dt);
    const after = [];
    for (let pass = 0; pass < passes; pass += 1) {
      const one = { massA: masses[0], massB: masses[1], error: errors[0], dt };
      ({ speedA: a, speedB: b } = laws.rodSolved({ ...one, speedA: a, speedB: b }));
      const two = { massA: masses[1], massB: masses[2], error: errors[1], dt };
      ({ speedA: b, speedB: c } = laws.rodSolved({ ...two, speedA: b, speedB: c }));
      after.push([b - a, c - b]);
    }
    return { meant, after, speeds: [a, b, c] };
  },

  /**
   * A full disc that starts by sliding: its speed, its spin times its radius, whether it rolls; how
   * far it has come, and how far its rim has turned, px.
   */
  sliding(speed, friction, seconds) {
    const slows = friction * laws.GRAVITY; // px/s²
    const share = slows > 0 ? Math.min((3 * slows * seconds) / speed, 1) : 0; // of the way to rolling
    const now = { speed: speed * (1 - share / 3), rim: (speed * 2 * share) / 3 }; // px/s
    const slid = slows > 0 ? Math.min(seconds, speed / (3 * slows)) : seconds; // s
    const rolled = seconds - slid; // s
    const way = (slid * (speed + now.speed)) / 2 + rolled * now.speed;
    const turned = (slid * now.rim) / 2 + rolled * now.rim;
    return { ...now, rolls: share === 1, way, turned };
  },

  /**
   * What a step of h radians of a spring's swing makes of [place, speed / omega], as a matrix.
   * Its determinant says whether swings grow: 1 for the symplectic two.
   */
  integrators: {
    explicit_euler: (h) => [1, h, -h, 1],
    semi_implicit_euler: (h) => [1 - h ** 2, h, -h, 1],
    velocity_verlet: (h) => [1 - h ** 2 / 2, h, -h * (1 - h ** 2 / 4), 1 - h ** 2 / 2],
    rk4(h) {
      const [same, other] = [1 - h ** 2 / 2 + h ** 4 / 24, h - h ** 3 / 6];
      return [same, other, -other, same];
    },
  },
};
