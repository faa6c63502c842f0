// What wasi-libc may ask of its system. Weir reads no files and prints nothing: its program needs none of this today,
// and whatever a later libc pulls in is answered with "not supported", never with a crash at load time.
const NOT_SUPPORTED = 58; // ENOTSUP in WASI

// Import objects of all modules that `module` names beside `served`.
export function wasiImports(module: WebAssembly.Module, served: WebAssembly.Imports): WebAssembly.Imports {
  const imports: WebAssembly.Imports = { ...served };
  const wasi: WebAssembly.ModuleImports = {};
  for (const entry of WebAssembly.Module.imports(module))
    if (entry.module === 'wasi_snapshot_preview1') wasi[entry.name] = () => NOT_SUPPORTED;
  imports['wasi_snapshot_preview1'] = wasi;
  return imports;
}
