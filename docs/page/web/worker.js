// The worker: the module, and one request after another.

let exports;

// Functions that libraries import, and that no calculation calls: those of random numbers and of the names of files.
function unused(module) {
  const imports = {};
  for (const { module: from, name } of WebAssembly.Module.imports(module)) {
    imports[from] ??= {};
    imports[from][name] = () => {
      throw new Error(`${name} is not in this page`);
    };
  }
  return imports;
}

// Addresses above 2 GiB arrive as negative numbers.
function ask(request) {
  const text = new TextEncoder().encode(JSON.stringify(request));
  const at = exports.allocate(text.length) >>> 0;
  new Uint8Array(exports.memory.buffer, at, text.length).set(text);
  exports.compute();
  return new Uint8Array(exports.memory.buffer, exports.address() >>> 0, exports.length()).slice();
}

onmessage = async ({ data: { module, number, request } }) => {
  try {
    if (module) {
      exports = (await WebAssembly.instantiate(module, unused(module))).exports;
      postMessage({ number, bytes: new Uint8Array() });
      return;
    }
    const began = performance.now();
    const bytes = ask(request);
    postMessage({ number, bytes, seconds: (performance.now() - began) / 1000 });
  } catch (error) {
    postMessage({ number, failure: String(error) });
  }
};
