// The form, the calculations that follow a change of it, and what they show.

const form = document.getElementById("form");
const at = (id) => document.getElementById(id);
let state = decode(location.hash.slice(1));
let library = [];
let shown = {}; // What is on the page: the case and its answers.

// The worker. A new change ends a calculation that is under way: the worker is replaced.
const worker = {
  module: null, own: null, busy: false, waiting: new Map(), count: 0,
  source: URL.createObjectURL(new Blob([WORKER], { type: "text/javascript" })),
  async start() {
    this.own = new Worker(this.source);
    this.own.onmessage = ({ data }) => {
      const { resolve, begun } = this.waiting.get(data.number) ?? {};
      if (data.begun) {
        try {
          return begun?.(data);
        } catch (error) {
          return this.end(String(error));
        }
      }
      this.waiting.delete(data.number);
      resolve?.(data);
    };
    this.own.onerror = ({ message }) => this.end(message || "the worker does not start");
    const { failure } = await this.send({ module: this.module });
    if (failure) throw new Error(failure);
  },
  // `begun` takes the first part of the answer, which arrives while the rest is computed.
  send(message, begun) {
    const number = ++this.count;
    return new Promise((resolve) => {
      this.waiting.set(number, { resolve, begun });
      this.own.postMessage({ ...message, number });
    });
  },
  // What is under way has no answer but this failure.
  end(failure) {
    for (const { resolve } of this.waiting.values()) resolve({ failure });
    this.waiting.clear();
  },
  async restart() {
    this.own.terminate();
    this.end(REPLACED);
    await this.start();
  },
};

const REPLACED = "a later change has ended it";

async function ask(request, begun) {
  const { bytes, seconds, failure } = await worker.send({ request }, begun);
  if (!failure) return { bytes, seconds };
  // A module that has failed once computes nothing more.
  if (failure !== REPLACED) await worker.restart();
  throw new Error(`the calculation has ended: ${failure}`);
}

// A picture or table of the step that is kept.
async function bytesOf(request) {
  const { bytes } = await ask(request);
  if (bytes[0] === "{".charCodeAt(0)) throw new Error(JSON.parse(new TextDecoder().decode(bytes)).error);
  return bytes;
}

const parsed = (bytes, seconds) => ({ ...JSON.parse(new TextDecoder().decode(bytes)), seconds });

async function answerOf(request, begun) {
  const { bytes, seconds } = await ask(request, (data) => begun?.(parsed(data.begun, data.seconds)));
  const answer = parsed(bytes, seconds);
  if (answer.error) throw new Error(answer.error);
  return answer;
}

// --- The form

function element(name, properties = {}, ...children) {
  const own = Object.assign(document.createElement(name), properties);
  own.append(...children);
  return own;
}

function materialsIn(select, first) {
  select.replaceChildren(...first.map(([value, text]) => element("option", { value, textContent: text })));
  for (const kind of new Set(library.map((own) => own.kind ?? "other"))) {
    const group = element("optgroup", { label: kind });
    for (const own of library.filter((own) => (own.kind ?? "other") === kind)) {
      group.append(element("option", { value: own.name, textContent: own.name }));
    }
    select.append(group);
  }
}

// The row of a layer, or of the substrate.
function rowOf(part, index) {
  const isLayer = index !== undefined;
  const select = element("select", { ariaLabel: isLayer ? `material of layer ${index + 1}` : "material of the substrate" });
  materialsIn(select, [["", "own material"]]);
  select.value = part.material ?? "";
  select.onchange = () => {
    if (select.value) part.material = select.value;
    else delete part.material;
    drawStack();
    changed();
  };
  const head = element("div", { className: "head" }, select);
  if (isLayer) {
    head.append(numberOf(part, "thickness", "thickness, µm", true), "µm");
    const remove = element("button", { type: "button", textContent: "×", ariaLabel: `remove layer ${index + 1}` });
    remove.onclick = () => {
      state.layers.splice(index, 1);
      drawStack();
      changed();
    };
    head.append(remove);
  } else {
    head.append("substrate");
  }
  const details = element("details", { open: !part.material }, element("summary", { textContent: "moduli and strengths" }));
  const own = library.find((entry) => entry.name === part.material);
  for (const [key, name, unit] of PROPERTIES) {
    if (!isLayer && OF_LAYERS.includes(key)) continue;
    const known = own?.[key];
    const input = numberOf(part, key, name, false);
    input.placeholder = known === null || known === undefined ? "none" : String(known.value ?? known);
    details.append(element("label", {}, `${name} `, input, element("span", { textContent: unit })));
  }
  return element("div", { className: "part" }, head, details);
}

// An input of a number of a part of the stack.
function numberOf(part, key, name, isNeeded) {
  const input = element("input", { inputMode: "decimal", ariaLabel: name, value: part[key] ?? "" });
  input.dataset.key = key;
  input.oninput = () => {
    const value = Number(input.value.replace(",", "."));
    const empty = input.value.trim() === "";
    input.classList.toggle("wrong", Number.isNaN(value) || (empty && isNeeded));
    if (Number.isNaN(value)) return refused(name, input.value);
    if (empty) delete part[key];
    else part[key] = value;
    changed();
  };
  return input;
}

function drawStack() {
  at("layers").replaceChildren(...state.layers.map(rowOf));
  at("substrate").replaceChildren(rowOf(state.substrate));
}

const NUMBERS = ["diameter", "period", "radius", "force", "pressure"];

function drawForm() {
  materialsIn(form.elements.counterbody, [["", "rigid"]]);
  form.elements.counterbody.value = state.counterbody;
  for (const name of [...NUMBERS, "lattice", "load", "friction", "motion", "part", "samples"]) form.elements[name].value = state[name];
  form.elements.body.value = state.body;
  drawStack();
  drawChoices();
}

function drawChoices() {
  form.dataset.body = state.body;
  form.toggleAttribute("data-rubbing", state.friction > 0);
  form.toggleAttribute("data-sticking", sticks(state));
  at("friction-shown").textContent = state.friction;
  at("part-shown").textContent = state.part;
  at("load-unit").textContent = state.load === "cell" ? "mN" : "MPa";
}

// A field of the form. Text fields have the event "input", lists "change".
function entered({ target }) {
  const name = target.name;
  if (!name) return;
  let value = target.value;
  if (NUMBERS.includes(name) || ["friction", "part", "samples"].includes(name)) {
    value = Number(value.replace(",", "."));
    target.classList.toggle("wrong", !(value > 0) && !["friction", "part"].includes(name));
    if (Number.isNaN(value)) return refused(name, target.value);
  }
  if (Object.is(state[name], value)) return;
  state[name] = value;
  drawChoices();
  changed();
}

form.addEventListener("input", entered);
form.addEventListener("change", entered);

at("add").onclick = () => {
  state.layers.push({ material: "CrN", thickness: 1 });
  drawStack();
  changed();
};

// --- The calculations

let pause = 0;
let round = 0; // Counts the changes: what an earlier one has requested is dropped.

function changed() {
  outdated();
  history.replaceState(null, "", "#" + encode(state));
  pause = setTimeout(calculate, 150);
}

// What is shown is no longer that of the form.
function outdated() {
  round += 1;
  clearTimeout(pause);
  at("result").classList.add("outdated");
  at("error").hidden = true;
}

function refused(name, text) {
  outdated();
  showError(`${name}: "${text}" is not a number`);
}

const samples = (points) => `${points} × ${points} samples`;

async function calculate() {
  const own = round;
  if (worker.busy) await worker.restart();
  if (own !== round) return;
  worker.busy = true;
  try {
    await stages(own);
  } catch (error) {
    if (own === round) showError(error.message);
  } finally {
    if (own === round) worker.busy = false;
  }
}

// One grid after another: the coated body, the bare one, then the loads at which something fails. On the first grid the coated body is
// shown as it becomes known: its contact, its largest stresses, its section.
async function stages(own) {
  const has = state.layers.length > 0;
  const failures = []; // Of what stands beside the coated body.
  const beside = (what, request) => answerOf(request).catch((error) => {
    failures.push(`${what}: ${error.message}`);
    return null;
  });
  let radius;
  for (let points = FIRST; points <= state.samples; points *= 2) {
    at("status").textContent = `computing on ${samples(points)} …`;
    const put = (coated, isWhole) => {
      if (own !== round) return;
      shown = { coated, isWhole, points, bare: null, limit: shown.round === own ? shown.limit : null, failures, round: own };
      show();
    };
    // Numbers that are not converged are not shown without their warning.
    const begun = (known) => known.converged && put(known, false);
    const request = { task: "solve", case: caseOf(state, library, { points, radius }), pictures: true, coarse: points < state.samples, parts: points === FIRST };
    put(await answerOf(request, begun), true);
    if (own !== round) return;
    const { coated } = shown;
    if (has) {
      shown.bare = await beside("Bare substrate", { task: "solve", case: caseOf(state, library, { points, bare: true }), pictures: false });
      if (own !== round) return;
      show();
    }
    radius = coated.step.levels[0]?.contact_radius ?? undefined;
    // Limits are those of a counterbody that slides.
    if (points === FIRST && coated.step.strength?.length && !sticks(state)) {
      at("status").textContent = "searching the loads at which something fails …";
      shown.limit = await beside("Search of limits", { task: "limit", case: caseOf(state, library, { points, radius }) });
      if (own !== round) return;
      show();
    }
  }
  at("status").textContent = `${samples(shown.points)}; ${shown.coated.seconds.toFixed(2)} s`;
  document.body.dataset.done = String(own);
}

// --- What is shown

// A number is written to the first digit of its error, which is rounded up.
function digitOf(error) {
  return Math.floor(Math.log10(error));
}

// A difference in per cent with its sign, `digit` being the power of ten of its last digit.
function signed(difference, digit, round) {
  const step = 10 ** digit;
  const text = (round(difference / step) * step).toFixed(Math.max(0, -digit));
  return Number(text) > 0 ? `+${text}` : text;
}

// By how much a number differs from another one, no more exactly than the errors of both allow; "–" where one of them is missing.
function differenceOf(number, other) {
  if (!other?.value || number.value === null) return "–";
  const ratio = number.value / other.value;
  const difference = 100 * (ratio - 1);
  if (number.error === null || other.error === null) return `${signed(difference, -1, Math.round)} %`;
  const error = 100 * (number.error / Math.abs(other.value) + Math.abs(ratio / other.value) * other.error);
  if (Math.abs(difference) <= error) return "within the errors";
  // Nothing is stated beyond a hundredth of a per cent.
  const digit = Math.max(digitOf(error), -2);
  if (error > 0.3 * Math.abs(difference)) {
    return `${signed(difference - error, digit, Math.floor)} to ${signed(difference + error, digit, Math.ceil)} %`;
  }
  const shown = Math.ceil(error / 10 ** digit - 1e-9);
  // Nine and a bit is ten: one digit further left.
  const last = shown > 9 ? digit + 1 : digit;
  const rounded = (shown > 9 ? 1 : Math.max(shown, 1)) * 10 ** last;
  return `${signed(difference, last, Math.round)} ± ${rounded.toFixed(Math.max(0, -last))} %`;
}

// A line that is there only with a text.
function write(id, text) {
  at(id).hidden = !text;
  at(id).textContent = text ?? "";
}

function showError(message) {
  at("result").classList.remove("outdated");
  at("error").hidden = false;
  at("error").textContent = message;
  at("status").textContent = "";
  for (const id of ["verdict", "here", "unknown", "actions", "same"]) at(id).hidden = true;
  for (const id of ["numbers", "warnings", "pictures", "more"]) at(id).replaceChildren();
}

function show() {
  const { coated, isWhole, bare, limit, failures, points } = shown;
  at("result").classList.remove("outdated");
  at("error").hidden = true;
  at("status").textContent = `${samples(points)}: ${coated.seconds.toFixed(2)} s` + (isWhole ? "" : "; computing the rest …");
  // The search is made on the first grid alone.
  const searched = points === FIRST ? "" : `, on ${samples(FIRST)}`;
  write("verdict", limit ? limit.verdict + searched : coated.verdict);
  write("here", limit ? coated.verdict : null);
  const without = isWhole && coated.without_strength;
  write("unknown", without ? `${without}; give the strengths of layers and substrate under “moduli and strengths”` : null);
  showNumbers(coated, bare, points);
  const warnings = [...coated.warnings, ...(bare?.warnings ?? []).map((text) => `Bare substrate: ${text}`), ...failures];
  at("warnings").replaceChildren(...warnings.map((text) => element("li", { textContent: text })));
  showPictures(coated, isWhole);
  const limits = (limit?.tables ?? []).map((table) => ({ ...table, name: table.name + searched }));
  // What fails first stands before the largest stresses.
  const [contact, ...others] = coated.tables;
  const tables = [contact, ...limits, ...others].map(tableOf);
  const notes = [...coated.assumptions, ...(limit?.warnings ?? []).map((text) => `Search of limits, ${samples(FIRST)}: ${text}`)].map((text) => element("p", { textContent: text }));
  const details = element("details", { open: at("more").querySelector("details")?.open ?? false },
    element("summary", { textContent: "all tables" }), ...tables, ...notes);
  at("more").replaceChildren(details);
  at("actions").hidden = at("same").hidden = !isWhole;
}

function showNumbers(coated, bare, points) {
  const head = element("tr", {}, ...["", state.layers.length ? "coated" : "bare", ...(bare ? ["bare substrate", "difference"] : [])]
    .map((text) => element("th", { textContent: text, scope: "col" })));
  const rows = coated.numbers.map((number) => {
    const cells = [number.name, number.text];
    if (bare) {
      const other = bare.numbers.find(({ name }) => name === number.name);
      cells.push(other?.text ?? "–", differenceOf(number, other));
    }
    return element("tr", {}, ...cells.map((text, index) => element(index ? "td" : "th", { textContent: text })));
  });
  at("numbers").replaceChildren(element("caption", { textContent: `on ${samples(points)}` }), element("thead", {}, head), element("tbody", {}, ...rows));
}

// In the order in which they are shown.
const CAPTIONS = { pressure: "Contact pressure", slip: "Stick and slip", section: "Stresses in a vertical section, with interfaces", profiles: "Pressure across the contact" };

function showPictures({ pictures }, isWhole) {
  const order = Object.keys(CAPTIONS);
  const sorted = [...pictures].sort(([a], [b]) => order.indexOf(a) - order.indexOf(b));
  const figures = sorted.map(([name, svg]) => {
    const image = element("img", { alt: CAPTIONS[name], src: URL.createObjectURL(new Blob([svg], { type: "image/svg+xml" })) });
    const button = element("button", { type: "button", textContent: "PNG", disabled: !isWhole });
    button.dataset.picture = name;
    button.onclick = () => saveAnswer(`${name}.png`, { task: "picture", name }, "image/png");
    const figure = element("figure", {}, element("figcaption", {}, `${CAPTIONS[name]} `, button), image);
    figure.dataset.name = name;
    return figure;
  });
  at("pictures").querySelectorAll("img").forEach((image) => URL.revokeObjectURL(image.src));
  at("pictures").replaceChildren(...figures);
}

function tableOf({ name, head, rows, words }) {
  const kind = (index) => (index < words ? "word" : "");
  const line = (cells, tag) => element("tr", {}, ...cells.map((text, index) => element(tag, { textContent: text, className: kind(index) })));
  const table = element("table", {}, element("caption", { textContent: name }), element("thead", {}, line(head, "th")),
    element("tbody", {}, ...rows.map((row) => line(row, "td"))));
  return element("div", { className: "scroll" }, table);
}

// --- What is taken along

function save(name, content, type) {
  const link = element("a", { href: URL.createObjectURL(new Blob([content], { type })), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

async function saveAnswer(name, request, type) {
  try {
    save(name, await bytesOf(request), type);
  } catch (error) {
    at("status").textContent = `${name} is not saved: ${error.message}`;
  }
}

for (const button of document.querySelectorAll("[data-save]")) {
  button.onclick = () => {
    const name = button.dataset.save;
    if (name === "case") save("case.toml", shown.coated.case, "application/toml");
    else saveAnswer(`${name}.csv`, { task: "table", name }, "text/csv");
  };
}

at("copy").onclick = async () => {
  // Without https there is no clipboard.
  const copied = await navigator.clipboard?.writeText(location.href).then(() => true, () => false);
  at("copy").textContent = copied ? "copied" : "copy it from the address bar";
  setTimeout(() => (at("copy").textContent = "copy the address"), 1500);
};

addEventListener("hashchange", () => {
  state = decode(location.hash.slice(1));
  outdated();
  drawForm();
  calculate();
});

async function begin() {
  const packed = Uint8Array.from(atob(MODULE), (c) => c.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
  worker.module = await WebAssembly.compile(await new Response(stream).arrayBuffer());
  await worker.start();
  library = (await answerOf({ task: "materials" })).materials;
  drawForm();
  calculate();
}

begin().catch((error) => showError(`this browser cannot run the page: ${error}`));
