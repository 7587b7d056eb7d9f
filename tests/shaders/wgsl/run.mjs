// Answers the cases of a suite by its WGSL port, on whatever device npm's webgpu finds:
//
//   node run.mjs VECTORS PORT.wgsl ANSWERS.bin
//
// VECTORS: a folder that `rawtexel vectors` wrote. ANSWERS.bin is for `rawtexel verify-shader --outputs`. Exit code 77: there is no WebGPU
// here, with the reason on stderr; 1: the port does not compile, with its messages.
import { readFileSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const [vectors, port, answers] = process.argv.slice(2);
if (!answers) {
    console.error('usage: node run.mjs VECTORS PORT.wgsl ANSWERS.bin');
    process.exit(2);
}
const kResultBytes = 64, kCaseBytes = 256, kGroup = 64;

function skip(why) {
    console.error(`skipped: ${why}`);
    process.exit(77);
}

// A port with the files that its lines `// include "FILE"` name, each once, found beside this script.
const root = dirname(fileURLToPath(import.meta.url));
const included = new Set();
function load(path) {
    if (included.has(path)) return '';
    included.add(path);
    return readFileSync(path, 'utf8').replace(/^\/\/ include "(.*)"$/gm, (line, name) => load(join(root, name)));
}

let webgpu;
try {
    webgpu = await import('webgpu');
} catch {
    skip('npm package webgpu is not installed: run `npm install` in tests/shaders/wgsl');
}
Object.assign(globalThis, webgpu.globals);
const gpu = webgpu.create([]);
const adapter = await gpu.requestAdapter();
if (!adapter) skip('WebGPU has no device: it needs a Vulkan driver with everything that Dawn asks for, such as SwiftShader');
const most = adapter.limits.maxStorageBufferBindingSize;
const device = await adapter.requestDevice({ requiredLimits: { maxStorageBufferBindingSize: most, maxBufferSize: adapter.limits.maxBufferSize } });

const module = device.createShaderModule({ code: load(port) });
const { messages } = await module.getCompilationInfo();
for (const m of messages) console.error(`${port}: ${m.type}: ${m.message} (line ${m.lineNum} of all files together)`);
if (messages.some((m) => m.type === 'error')) process.exit(1);

// Bindings 0 to 4: cases, answers, textures, texels, words.
const cases = readFileSync(join(vectors, 'cases.bin'));
const count = cases.length / kCaseBytes;
const contents = [cases, Buffer.alloc(count * kResultBytes), ...['textures.bin', 'texels.bin', 'words.bin'].map((name) => readFileSync(join(vectors, name)))];
const buffers = contents.map((bytes) => {
    const buffer = device.createBuffer({
        size: Math.max(bytes.length, 16),
        usage: GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_SRC | GPUBufferUsage.COPY_DST,
    });
    if (bytes.length > 0) device.queue.writeBuffer(buffer, 0, bytes);
    return buffer;
});
const layout = device.createBindGroupLayout({
    entries: buffers.map((_, binding) => ({
        binding,
        visibility: GPUShaderStage.COMPUTE,
        buffer: { type: binding === 1 ? 'storage' : 'read-only-storage' },
    })),
});
const pipeline = await device.createComputePipelineAsync({
    layout: device.createPipelineLayout({ bindGroupLayouts: [layout] }),
    compute: { module, entryPoint: 'main' },
});
const group = device.createBindGroup({ layout, entries: buffers.map((buffer, binding) => ({ binding, resource: { buffer } })) });
const back = device.createBuffer({ size: count * kResultBytes, usage: GPUBufferUsage.MAP_READ | GPUBufferUsage.COPY_DST });

const encoder = device.createCommandEncoder();
const pass = encoder.beginComputePass();
pass.setPipeline(pipeline);
pass.setBindGroup(0, group);
pass.dispatchWorkgroups(Math.ceil(count / kGroup));
pass.end();
encoder.copyBufferToBuffer(buffers[1], 0, back, 0, count * kResultBytes);
device.queue.submit([encoder.finish()]);
await back.mapAsync(GPUMapMode.READ);
writeFileSync(answers, Buffer.from(back.getMappedRange()));
console.log(`${count} cases answered by ${adapter.info.vendor} ${adapter.info.architecture}`);
process.exit(0);
