// The state of the page: what the form shows, in the address behind "#", and as a case of percoat. Lengths of a case are in µm and
// pressures in GPa, so that forces are in mN.

const DEFAULT = {
  body: "ball", diameter: 6, lattice: "square", period: 20, radius: 50, counterbody: "100Cr6",
  force: 5, load: "pressure", pressure: 50, friction: 0.2, motion: "slides", part: 0.6, samples: 192,
  layers: [{ material: "TiAlN", thickness: 3 }],
  substrate: { material: "D2" },
};

// Values of the fields that are lists.
const CHOICES = { body: ["ball", "asperities"], lattice: ["square", "hexagonal"], load: ["pressure", "cell"], motion: ["slides", "sticks"], samples: [96, 192, 384] };

// Keys of a material that the form can set, with their names and units; the last three are those of layers.
const PROPERTIES = [
  ["young", "Young's modulus", "GPa"],
  ["poisson", "Poisson's ratio", ""],
  ["yield_strength", "yield strength", "GPa"],
  ["tensile_strength", "tensile strength", "GPa"],
  ["residual_stress", "residual stress", "GPa"],
  ["normal", "normal strength of the interface below", "GPa"],
  ["shear", "shear strength of the interface below", "GPa"],
];
const OF_LAYERS = ["residual_stress", "normal", "shear"];

// Samples of the first answer; those that follow have twice as many, up to the state's own.
const FIRST = 96;

function encode(state) {
  const bytes = new TextEncoder().encode(JSON.stringify(state));
  return btoa(String.fromCharCode(...bytes)).replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "");
}

// The state of an address: what is usable of it, and the default one for the rest.
function decode(text) {
  const state = structuredClone(DEFAULT);
  let given;
  try {
    const bytes = Uint8Array.from(atob(text.replaceAll("-", "+").replaceAll("_", "/")), (c) => c.charCodeAt(0));
    given = JSON.parse(new TextDecoder().decode(bytes));
  } catch {
    return state;
  }
  const isUsable = (key, value) => CHOICES[key]?.includes(value) ?? (typeof value === typeof DEFAULT[key] && !Number.isNaN(value));
  for (const key of Object.keys(DEFAULT)) {
    if (key !== "layers" && key !== "substrate" && isUsable(key, given?.[key])) state[key] = given[key];
  }
  if (Array.isArray(given?.layers)) state.layers = given.layers.map(usablePart);
  if (typeof given?.substrate === "object") state.substrate = usablePart(given.substrate);
  return state;
}

// What is usable of a layer or the substrate.
function usablePart(given) {
  const part = typeof given?.material === "string" ? { material: given.material } : {};
  for (const key of ["thickness", ...PROPERTIES.map(([key]) => key)]) {
    if (Number.isFinite(given?.[key])) part[key] = given[key];
  }
  return part;
}

function rounded(x, digits) {
  return Number(x.toPrecision(digits));
}

// The plane modulus E/(1 − ν²) of a material; infinite for a rigid one.
function planeModulus(part, library) {
  const own = library.find((entry) => entry.name === part.material);
  const young = part.young ?? own?.young.value ?? own?.young;
  const poisson = part.poisson ?? own?.poisson.value ?? own?.poisson;
  return young > 0 && poisson < 1 ? young / (1 - poisson ** 2) : Infinity;
}

// The largest contact radius that Hertz gives the ball on any of the bare materials, µm.
function largestRadius(state, library) {
  const counterbody = planeModulus({ material: state.counterbody }, library);
  const softest = Math.min(...[...state.layers, state.substrate].map((part) => planeModulus(part, library)));
  const compliance = 1 / softest + 1 / counterbody;
  return Math.cbrt(0.75 * 1000 * state.force * 500 * state.diameter * compliance);
}

// Part of the case: a layer or the substrate.
function partOf(part) {
  const section = {};
  if (part.material) section.material = part.material;
  if (part.thickness !== undefined) section.thickness = part.thickness;
  for (const [key] of PROPERTIES) {
    if (part[key] !== undefined && key !== "normal" && key !== "shear") section[key] = part[key];
  }
  const strength = {};
  if (part.normal !== undefined) strength.normal = part.normal;
  if (part.shear !== undefined) strength.shear = part.shear;
  if (Object.keys(strength).length) section.interface_strength = strength;
  return section;
}

// Whether friction holds the counterbody back, at a force that it bears.
function sticks(state) {
  return state.friction > 0 && state.motion === "sticks";
}

function titleOf(state, bare) {
  const name = (part) => part.material || "own material";
  const layers = bare ? [] : state.layers.map((layer) => `${layer.thickness} µm ${name(layer)} on `);
  const above = state.body === "ball" ? `Ball of ${state.diameter} mm` : `Asperities of ${state.radius} µm, ${state.period} µm apart`;
  const of = state.counterbody ? `, ${state.counterbody},` : "";
  const load = state.body === "ball" ? `${state.force} N` : state.load === "cell" ? `${state.pressure} mN each` : `${state.pressure} MPa`;
  return `${above}${of} on ${layers.join("")}${name(state.substrate)}, ${load}` + (state.friction > 0 ? `, μ = ${state.friction}` : "") + (sticks(state) ? `, Q = ${state.part} μP` : "");
}

// The case of a state on a grid. `radius`: the contact radius where it is known, µm; `bare`: without the layers.
function caseOf(state, library, { points, radius, bare = false }) {
  const layers = bare ? [] : state.layers.map(partOf);
  const thickness = state.layers.reduce((sum, layer) => sum + (layer.thickness ?? 0), 0);
  const own = { title: titleOf(state, bare) };
  let length, depth;
  if (state.body === "ball") {
    const reach = radius ?? largestRadius(state, library);
    length = rounded(3.2 * reach, 2);
    depth = Math.max(1.5 * reach, Math.min(2.5 * thickness, 3 * reach));
    own.lattice = { kind: "isolated", size: length };
    own.levels = [{ shape: "sphere", radius: 500 * state.diameter }];
    own.load = { force: 1000 * state.force };
  } else {
    length = state.period;
    depth = Math.max(0.6 * state.period, Math.min(2.5 * thickness, state.period));
    own.lattice = { kind: state.lattice, period: state.period };
    own.levels = [{ shape: "sphere", radius: state.radius }];
    own.load = state.load === "cell" ? { force: state.pressure } : { mean_pressure: state.pressure / 1000 };
  }
  if (layers.length) own.layers = layers;
  own.substrate = partOf(state.substrate);
  if (state.counterbody) own.counterbody = { material: state.counterbody };
  if (state.friction > 0) own.friction = { coefficient: state.friction };
  if (sticks(state)) own.tangential = { force: [state.part] };
  own.units = { length: "µm", pressure: "GPa" };
  own.grid = { points };
  // Down to rounding, so that the command line has the same numbers whatever its processor; tractions are not solved as closely.
  own.solver = { tolerance: sticks(state) ? 1e-11 : 1e-14 };
  own.stress = {
    mean: "half-space",
    section: { from: "level 1", toward: [1, 0], length, behind: length / 2, depth: rounded(depth, 2) },
  };
  return own;
}
