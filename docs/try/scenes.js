// What the page says of each scene and model; their numbers are C++ (scenes.hpp).
'use strict';

// view: what is drawn [m], x then w, where w is magnified.  model: the one that the scene begins with.
const scenes = [
  {
    name: 'Steel bar', ends: ['pinned', 'pinned'], magnified: 6, view: [-0.16, 2.7, -0.72, 0.55], model: 0,
    title: 'A steel bar, 2.54 m long and 25.4 mm square',
    feel: 'A wall that gives a little. The bar is six times stiffer than the spring, so nearly all of the way is lag.',
  },
  {
    name: 'Ruler', ends: ['clamped', 'free'], magnified: 1, view: [-0.04, 0.36, -0.2, 0.07], model: 2,
    title: 'A steel ruler, 300 × 25 × 1 mm, clamped at the left',
    feel: 'It resists, turns, and lets the ball slide along it until it slips off. The first two models are for moderate ' +
      'rotations, and the ruler turns further: look at their error.',
  },
  {
    name: 'String', ends: ['pinned', 'pinned'], magnified: 8, view: [-0.045, 0.695, -0.21, 0.14], model: 1,
    title: 'A steel string, 650 mm long, 0.8 mm thick, under 80 N',
    feel: 'A spring that is soft in the middle and hard at the ends. Its tension pushes back, and hardly its stiffness.',
  },
  {
    name: 'Arch', ends: ['pinned', 'pinned'], magnified: 1, view: [-0.016, 0.216, -0.06, 0.052], model: 2,
    title: 'An arch of spring steel, span 200 mm, rise 12 mm',
    feel: 'A click. It resists, tilts, gives way and snaps through to its other side. Press it back from below.',
  },
  {
    name: 'Strip', ends: ['pinned', 'pinned'], magnified: 10, view: [-0.03, 0.43, -0.14, 0.09], model: 4,
    title: 'A steel strip, 400 × 20 × 0.5 mm, whose ends cannot approach',
    feel: 'Nothing, then more and more, then a wall. It bends like paper and stretches like steel: the force grows with ' +
      'the cube of the depth.',
  },
  {
    name: 'Your own', own: true, model: 1, title: 'A beam of your own, 20 mm wide',
    feel: 'Choose its length, thickness, material and ends. The spring is as stiff as the beam where it is pressed first.',
  },
];

// Of a beam of one's own, by its list of ends.
const ownEnds = [['pinned', 'pinned'], ['clamped', 'clamped'], ['clamped', 'free']];

// What is drawn of it.   figures: [length, thickness, young, density, ends]
function drawnOwn([length, , , , kind]) {
  const cantilever = ownEnds[kind][1] === 'free', part = cantilever ? [-0.13, 1.2, -0.6, 0.23] : [-0.07, 1.07, -0.32, 0.24];
  return {ends: ownEnds[kind], magnified: cantilever ? 1 : 8, view: part.map((x) => x * length)};
}

const models = [
  ['FemModel', '8 elements, moderate rotation'],
  ['FemModel', '16 elements, moderate rotation'],
  ['FemModel, Corotational', '8 elements, finite rotation'],
  ['FemModel, Corotational', '16 elements, finite rotation'],
  ['PodModel', 'reduced, 16 × 12 snapshots'],
  ['GalerkinModel', 'reduced, 16 × 12 snapshots'],
  ['DynamicModel', 'with mass, swings and is heard'],
];

const statusText = {
  0: '', 1: 'out of range: the model goes on from its last answer', 2: 'snapped to another equilibrium',
  '-1': 'invalid request', '-2': 'still on its way', '-3': 'singular', '-4': 'not finite',
};
