// The worker: the module, and one request after another.

let exports;
let current; // The request under way: its number, and when it began.

// What the module imports: the function that takes the first part of an answer, and those of libraries that no calculation calls
// (random numbers, names of files).
function importsOf(module) {
  const imports = {};
  for (const { module: from, name } of WebAssembly.Module.imports(module)) {
    imports[from] ??= {};
    imports[from][name] = () => {
      throw new Error(`${name} is not in this page`);
    };
  }
  imports.page = { begun: (address, length) => send({ begun: bytesAt(address, length) }) };
  return imports;
}

// Addresses above 2 GiB arrive as negative numbers.
function bytesAt(address, length) {
  return new Uint8Array(exports.memory.buffer, address >>> 0, length).slice();
}

function ask(request) {
  const text = new TextEncoder().encode(JSON.stringify(request));
  const at = exports.allocate(text.length) >>> 0;
  new Uint8Array(exports.memory.buffer, at, text.length).set(text);
  exports.compute();
  return bytesAt(exports.address(), exports.length());
}

function send(message) {
  postMessage({ number: current.number, seconds: (performance.now() - current.began) / 1000, ...message });
}

onmessage = async ({ data: { module, number, request } }) => {
  current = { number, began: performance.now() };
  try {
    if (module) exports = (await WebAssembly.instantiate(module, importsOf(module))).exports;
    send({ bytes: module ? new Uint8Array() : ask(request) });
  } catch (error) {
    postMessage({ number, failure: String(error) });
  }
};
