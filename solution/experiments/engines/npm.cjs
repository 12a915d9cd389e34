// Run scenes in Rapier and planck: a line of JSON asks, a line of JSON answers. See npm.py.
"use strict";

const find = (name) => require.resolve(name, { paths: [process.cwd(), __dirname] });
const load = (name) => {
  try {
    return require(find(name));
  } catch {
    return null;
  }
};
const RAPIER = load("@dimforge/rapier2d-compat");
const PLANCK = load("planck");

const has = (scene, effect) => scene.effects.includes(effect);
const damping = (scene) => (has(scene, "Damping") ? scene.damping : [0, 0]);
const surface = (scene, body) => ({
  friction: has(scene, "Friction") ? body.friction : 0,
  restitution: has(scene, "Bounce") ? body.restitution : 0,
});
const joints = (scene, springs) => [
  ...(has(scene, "Rods") ? scene.rods.map(([a, b]) => ({ a, b, rod: true })) : []),
  ...(has(scene, "Springs") ? scene.springs.map((s, i) => ({ ...s, soft: springs[i] })) : []),
];
const distance = (scene, { a, b }) =>
  Math.hypot(...[0, 1].map((k) => scene.bodies[a].pos[k] - scene.bodies[b].pos[k]));

// Rapier works in the scene's own unit: it is told how long a metre is.
class Rapier {
  constructor({ scene, springs, substeps, metre }) {
    this.world = new RAPIER.World({ x: scene.gravity[0], y: scene.gravity[1] });
    this.world.lengthUnit = metre;
    this.world.numSolverIterations = substeps;
    this.bodies = scene.bodies.map((body) => this.add(scene, body));
    for (const joint of joints(scene, springs)) this.tie(scene, joint);
  }
  add(scene, body) {
    const moves = body.radius && body.mass > 0;
    const R = RAPIER.RigidBodyDesc;
    const desc = (moves ? R.dynamic() : R.fixed()).setTranslation(...body.pos);
    if (moves) {
      desc.setLinvel(...body.vel).setAngvel(body.omega);
      desc.setCcdEnabled(body.bullet && has(scene, "Bullets"));
      desc.setCanSleep(has(scene, "Sleep"));
      desc.setLinearDamping(damping(scene)[0]).setAngularDamping(damping(scene)[1]);
    }
    const made = this.world.createRigidBody(desc);
    const shape = body.radius ? RAPIER.ColliderDesc.ball(body.radius) : RAPIER.ColliderDesc.cuboid(...body.half);
    const { friction, restitution } = surface(scene, body);
    // The friction of a pair is the root of the product in all engines: here a product of roots.
    shape.setFriction(Math.sqrt(friction)).setFrictionCombineRule(RAPIER.CoefficientCombineRule.Multiply);
    shape.setRestitution(restitution).setRestitutionCombineRule(RAPIER.CoefficientCombineRule.Min);
    if (moves) shape.setMass(body.mass);
    if (!has(scene, "Contacts")) shape.setCollisionGroups(0);
    this.world.createCollider(shape, made);
    return made;
  }
  tie(scene, joint) {
    const middle = { x: 0, y: 0 };
    const J = RAPIER.JointData;
    const data = joint.rod
      ? J.rope(distance(scene, joint), middle, middle)
      : J.spring(joint.length, joint.stiffness, joint.damping, middle, middle);
    const made = this.world.createImpulseJoint(data, this.bodies[joint.a], this.bodies[joint.b], true);
    made.setContactsEnabled(false);
  }
  step(dt) {
    this.world.timestep = dt;
    this.world.step();
  }
  read(body) {
    const [p, v] = [body.translation(), body.linvel()];
    return [p.x, p.y, v.x, v.y, body.rotation(), body.angvel()];
  }
  throw(i, [x, y]) {
    this.bodies[i].setLinvel({ x, y }, true);
  }
}

class Planck {
  constructor({ scene, springs, substeps, metre }) {
    [this.metre, this.substeps] = [metre, substeps];
    this.world = new PLANCK.World({ gravity: this.metres(scene.gravity) });
    this.bodies = scene.bodies.map((body) => this.add(scene, body));
    for (const joint of joints(scene, springs)) this.tie(scene, joint);
  }
  metres([x, y]) {
    return { x: x / this.metre, y: y / this.metre };
  }
  add(scene, body) {
    const moves = body.radius && body.mass > 0;
    const made = this.world.createBody({
      type: moves ? "dynamic" : "static",
      position: this.metres(body.pos),
      linearVelocity: this.metres(moves ? body.vel : [0, 0]),
      angularVelocity: moves ? body.omega : 0,
      linearDamping: damping(scene)[0],
      angularDamping: damping(scene)[1],
      bullet: Boolean(moves && body.bullet && has(scene, "Bullets")),
      allowSleep: has(scene, "Sleep"),
    });
    const shape = body.radius
      ? new PLANCK.Circle(body.radius / this.metre)
      : new PLANCK.Box(...body.half.map((half) => half / this.metre));
    made.createFixture(shape, {
      ...surface(scene, body),
      density: moves ? (body.mass / (Math.PI * body.radius ** 2)) * this.metre ** 2 : 0,
      filterGroupIndex: has(scene, "Contacts") ? 0 : -1,
    });
    return made;
  }
  tie(scene, joint) {
    const soft = joint.rod ? {} : { frequencyHz: joint.soft[0], dampingRatio: joint.soft[1] };
    const made = new PLANCK.DistanceJoint({
      ...soft,
      bodyA: this.bodies[joint.a],
      bodyB: this.bodies[joint.b],
      localAnchorA: { x: 0, y: 0 },
      localAnchorB: { x: 0, y: 0 },
      collideConnected: false,
      length: (joint.rod ? distance(scene, joint) : joint.length) / this.metre,
    });
    this.world.createJoint(made);
  }
  step(dt) {
    for (let i = 0; i < this.substeps; i++) this.world.step(dt / this.substeps);
  }
  read(body) {
    const [p, v] = [body.getPosition(), body.getLinearVelocity()];
    const px = [p.x, p.y, v.x, v.y].map((number) => number * this.metre);
    return [...px, body.getAngle(), body.getAngularVelocity()];
  }
  throw(i, velocity) {
    this.bodies[i].setLinearVelocity(this.metres(velocity));
    this.bodies[i].setAwake(true);
  }
}

const ENGINES = { rapier: Rapier, planck: Planck };
const KEPT = 8; // scenes at a time
const scenes = new Map();
let count = 0;

const states = (scene) => scene.bodies.map((body) => scene.read(body));
const answers = {
  build(asked) {
    const scene = new ENGINES[asked.engine](asked);
    scenes.set(++count, scene);
    scenes.get(count - KEPT)?.world.free?.(); // Rapier's memory is its own
    scenes.delete(count - KEPT);
    return { id: count, states: states(scene) };
  },
  step({ id, dt }) {
    const scene = scenes.get(id);
    const start = process.cpuUsage();
    scene.step(dt);
    const { user, system } = process.cpuUsage(start);
    return { states: states(scene), seconds: (user + system) / 1e6 };
  },
  throw({ id, body, velocity }) {
    scenes.get(id).throw(body, velocity);
    return {};
  },
};

const say = (data) => process.stdout.write(JSON.stringify(data) + "\n");
const start = async () => {
  if (RAPIER) await RAPIER.init();
  const found = {};
  if (RAPIER) found.rapier = RAPIER.version();
  if (PLANCK) {
    const file = require("path").join(find("planck"), "../../package.json");
    found.planck = JSON.parse(require("fs").readFileSync(file)).version;
  }
  say(found);
  for await (const line of require("readline").createInterface({ input: process.stdin })) {
    const asked = JSON.parse(line);
    say(answers[asked.do](asked));
  }
};
start();
