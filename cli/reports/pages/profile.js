// The page of `rawtexel profile`.
'use strict';

const byId = id => document.getElementById(id);
const width = data.image.width, height = data.image.height;
// The numbers of every setting: the profile's own, then those beside it.
const numbers = [data, ...data.compare_with];
const settingNames = numbers.map((n, i) => i === 0 ? 'as profiled' : n.options);
const layerTitles = {
    texels_requested: 'texel reads', lines_pixel: 'distinct 64-byte lines', lines_first: '64-byte lines touched first here',
    blocks_first: '4×4 blocks touched first here', l1_miss: 'L1 misses', l2_miss: 'L2 misses', level: 'mean level of detail',
    anisotropy: 'mean anisotropy', samples: 'samples that saw a surface',
};
const layers = data.settings[0].layers.map(layer => layer.name);

// --- Pictures and maps

const decoded = new Map();
/** The numbers of a layer, one a pixel, from the bytes of its picture. */
function layerValues(setting, name) {
    const key = `${setting} ${name}`;
    if (!decoded.has(key)) decoded.set(key, decodeLayer(data.settings[setting].layers.find(layer => layer.name === name)));
    return decoded.get(key);
}

async function decodeLayer(layer) {
    const picture = await loadPicture(layer.source);
    const canvas = element('canvas', {width, height});
    const context = canvas.getContext('2d', {willReadFrequently: true, colorSpace: 'srgb'});
    context.drawImage(picture, 0, 0);
    const codes = context.getImageData(0, 0, width, height).data;
    const values = new Float32Array(width * height);
    for (let i = 0; i < values.length; ++i) values[i] = (codes[4 * i] * 65536 + codes[4 * i + 1] * 256 + codes[4 * i + 2]) / layer.units;
    return values;
}

const ranges = new Map();
/** The largest value of a layer over all settings. */
async function layerRange(name) {
    if (!ranges.has(name)) {
        let most = 0;
        for (let setting = 0; setting < numbers.length; ++setting) for (const value of await layerValues(setting, name)) if (value > most) most = value;
        ranges.set(name, most);
    }
    return ranges.get(name);
}

async function drawLayer(setting, name) {
    const values = await layerValues(setting, name), most = await layerRange(name);
    const canvas = element('canvas', {width, height});
    const pixels = new ImageData(width, height);
    const scale = most > 0 ? 255 / most : 0;
    for (let i = 0; i < values.length; ++i) {
        const at = Math.round(values[i] * scale) * 3;
        pixels.data[4 * i] = mapColours[at];
        pixels.data[4 * i + 1] = mapColours[at + 1];
        pixels.data[4 * i + 2] = mapColours[at + 2];
        pixels.data[4 * i + 3] = 255;
    }
    canvas.getContext('2d').putImageData(pixels, 0, 0);
    return canvas;
}

const settled = new Map();  // layers that are decoded, for the read-out
const slider = new Slider(byId('pictures'), width, height, (x, y) => {
    const lines = [`pixel ${x + data.origin[0]}, ${y + data.origin[1]}`];
    const shown = [...new Set(['left', 'right'].map(side => byId(`${side}-setting`).selectedIndex))];
    for (const setting of shown) {
        const values = layers.filter(name => settled.has(`${setting} ${name}`))
            .map(name => `${name} ${figure(settled.get(`${setting} ${name}`)[y * width + x])}`);
        lines.push((numbers.length > 1 ? `${settingNames[setting]}: ` : '') + values.join('  '));
    }
    return lines.join('\n');
});

async function show(side) {
    const setting = byId(`${side}-setting`).selectedIndex, layer = byId(`${side}-layer`).value;
    const suffix = numbers.length > 1 ? `, ${settingNames[setting]}` : '';
    const legend = byId(`legend-${side}`);
    legend.hidden = layer === 'render';
    if (layer === 'render') {
        slider.show(side, await loadPicture(data.settings[setting].picture), `render${suffix}`);
    } else {
        slider.show(side, await drawLayer(setting, layer), layerTitles[layer] + suffix);
        showLegend(legend, `${side}: ${layerTitles[layer]}`, 0, await layerRange(layer));
    }
    document.body.dataset[`${side}Layer`] = `${setting} ${layer}`;
}

for (const side of ['left', 'right']) {
    byId(`${side}-setting`).append(...settingNames.map(name => element('option', {}, name)));
    byId(`${side}-layer`).append(element('option', {value: 'render'}, 'render'),
        ...layers.map(name => element('option', {value: name}, layerTitles[name])));
    for (const choice of ['setting', 'layer']) byId(`${side}-${choice}`).addEventListener('change', () => show(side));
    byId(`${side}-setting-label`).hidden = numbers.length === 1;
}
byId('right-layer').value = 'texels_requested';
if (numbers.length > 1) byId('right-setting').selectedIndex = 1;
byId('zoom').addEventListener('change', () => slider.zoom(Number(byId('zoom').value)));

document.addEventListener('keydown', event => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target.closest('select')) return;
    const step = (id, by) => {
        const select = byId(id);
        select.selectedIndex = (select.selectedIndex + by + select.length) % select.length;
        select.dispatchEvent(new Event('change'));
    };
    if (event.key.toLowerCase() === 'm') step('right-layer', event.shiftKey ? -1 : 1);
    else if (event.key.toLowerCase() === 'z') step('zoom', 1);
});

// --- Numbers

const counters = ['lookups', 'taps', 'texels_requested', 'texels_per_sample', 'texels_unique', 'blocks_touched', 'lines_32', 'lines_64', 'lines_128',
    'bytes_decoded', 'lines_stored_32', 'lines_stored_64', 'lines_stored_128', 'bytes_stored', 'overfetch', 'cache.l1_hits', 'cache.l1_misses',
    'cache.l2_hits', 'cache.l2_misses', 'cache.compulsory', 'cache.capacity', 'cache.conflict'];
const valueAt = (object, path) => path.split('.').reduce((value, key) => value?.[key], object);
const share = (part, other) => part + other > 0 ? part / (part + other) : null;
const hitRates = numbers => numbers.cache ? {
    l1_hit_rate: share(numbers.cache.l1_hits, numbers.cache.l1_misses), l2_hit_rate: share(numbers.cache.l2_hits, numbers.cache.l2_misses),
} : {};

/** A counter a line; each column's numbers, and how they differ from the first column's. */
function fillCounters(table, columns) {
    const all = [...counters, 'l1_hit_rate', 'l2_hit_rate'];
    const withRates = columns.map(column => ({...column, numbers: {...column.numbers, ...hitRates(column.numbers)}}));
    const rows = all.filter(counter => withRates.some(column => valueAt(column.numbers, counter) !== undefined)).map(counter => {
        const row = {counter};
        const first = valueAt(withRates[0].numbers, counter);
        withRates.forEach((column, i) => {
            const value = valueAt(column.numbers, counter);
            row[column.label] = value ?? null;
            if (i > 0) row[`${column.label} difference`] = value === first ? '=' : first ? `${value >= first ? '+' : '−'}${figure(Number((Math.abs(value / first - 1) * 100).toPrecision(3)))} %` : '–';
        });
        return row;
    });
    fillTable(table, [{key: 'counter', label: 'Counter'}, ...withRates.flatMap((column, i) => [
        {key: column.label, label: column.label}, ...(i > 0 ? [{key: `${column.label} difference`, label: `to ${withRates[0].label}`}] : [])])], rows);
}

fillCounters(byId('models'), Object.entries(data.models).map(([label, numbers]) => ({label, numbers})));
byId('own-model').textContent = data.fetches.model;
byId('settings-section').hidden = numbers.length === 1;
if (numbers.length > 1) fillCounters(byId('settings'), numbers.map((n, i) => ({label: settingNames[i], numbers: n.texture})));

const textureColumns = [
    {key: 'name', label: 'Texture'}, {key: 'level', label: 'Level'}, {key: 'format', label: 'Format'}, {key: 'extents', label: 'Extents'},
    {key: 'texels_requested', label: 'Texel reads'}, {key: 'texels_unique', label: 'distinct'}, {key: 'blocks_touched', label: 'Blocks', title: '4×4 texels'},
    {key: 'lines_64', label: 'Lines of 64 B'}, {key: 'bytes_decoded', label: 'Bytes decoded'}, {key: 'bytes_stored', label: 'Bytes stored'},
    {key: 'l1_hit_rate', label: 'L1 hit rate'}, {key: 'l2_hit_rate', label: 'L2 hit rate'}, {key: 'overfetch', label: 'Over-fetch', title: 'bytes of the lines over those of the distinct texels'},
];

function fillTextures() {
    const rows = [];
    const add = (texture, level, n) => rows.push({
        ...n, name: texture.name ?? 'all', level, format: texture.format ?? '', extents: n.width ? `${n.width}×${n.height}` : '', ...hitRates(n),
    });
    const chosen = numbers[byId('textures-setting').selectedIndex];
    for (const texture of chosen.textures) {
        add(texture, 'all', texture);
        if (byId('levels').getAttribute('aria-pressed') === 'true') for (const level of texture.per_level) add(texture, level.level, level);
    }
    add({}, 'all', chosen.texture);
    fillTable(byId('textures'), textureColumns, rows);
}

byId('levels').addEventListener('click', () => {
    byId('levels').setAttribute('aria-pressed', String(byId('levels').getAttribute('aria-pressed') !== 'true'));
    fillTextures();
});

// --- Histograms

/** Bars of `bins`, bin i from i * step on; those before `first` are empty. */
function histogram(title, unit, allBins, step, first = 0) {
    const bins = allBins.slice(first), from = i => (i + first) * step;
    const total = bins.reduce((sum, count) => sum + count, 0), most = Math.max(...bins, 1);
    const space = {left: 64, right: 12, top: 28, bottom: 44}, size = {width: 460, height: 240};
    const inner = {width: size.width - space.left - space.right, height: size.height - space.top - space.bottom};
    const svg = (name, attributes, ...children) => {
        const made = document.createElementNS('http://www.w3.org/2000/svg', name);
        for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
        made.append(...children);
        return made;
    };
    const bar = inner.width / Math.max(bins.length, 1);
    const parts = [svg('text', {x: space.left, y: 16, class: 'title'}, title)];
    bins.forEach((count, i) => {
        const tall = inner.height * count / most;
        parts.push(svg('rect', {x: space.left + i * bar, y: space.top + inner.height - tall, width: Math.max(bar - 1, 0.5), height: tall, 'data-count': count},
            svg('title', {}, `${figure(from(i))}${step === 1 ? '' : ` to ${figure(from(i + 1))}`}: ${figure(count)} lookups, ${figure(Number((100 * count / total).toPrecision(3)))} %`)));
    });
    const every = Math.max(1, Math.ceil(bins.length / 12));
    for (let i = 0; i <= bins.length; i += every)
        parts.push(svg('text', {x: space.left + i * bar + (step === 1 ? bar / 2 : 0), y: size.height - 26, class: 'tick middle'}, i < bins.length || step !== 1 ? figure(from(i)) : ''));
    for (const part of [0, 0.5, 1])
        parts.push(svg('line', {x1: space.left, x2: size.width - space.right, y1: space.top + inner.height * (1 - part), y2: space.top + inner.height * (1 - part), class: 'grid'}),
            svg('text', {x: space.left - 6, y: space.top + inner.height * (1 - part) + 4, class: 'tick end'}, total ? `${figure(Number((100 * most * part / total).toPrecision(3)))} %` : '0 %'));
    parts.push(svg('text', {x: space.left + inner.width / 2, y: size.height - 6, class: 'tick middle'}, unit));
    return svg('svg', {viewBox: `0 0 ${size.width} ${size.height}`, role: 'img', 'aria-label': title}, ...parts);
}

function fillHistograms() {
    const h = numbers[byId('histograms-setting').selectedIndex].histograms;
    byId('histograms').replaceChildren(
        histogram('Level of detail', 'level, share of all lookups', h.level, h.levels_per_bin),
        histogram('Anisotropy', 'ratio of the footprint’s axes (from n to n + 1), share of all lookups', h.anisotropy, 1, 1),
        histogram('Texels read', 'texels a lookup, share of all lookups', h.texels, 1));
}

// --- Residency

function fillResidency() {
    const figures = data.settings[byId('residency-setting').selectedIndex].residency.map(texture => {
        const touched = texture.levels.reduce((sum, level) => sum + level.blocks_touched, 0), blocks = texture.levels.reduce((sum, level) => sum + level.blocks, 0);
        const caption = element('figcaption', {}, element('strong', {}, texture.name), ` ${figure(touched)} of ${figure(blocks)} blocks`,
            element('span', {class: 'faint'}, texture.levels.map((level, i) => level.blocks_touched ? `; level ${i}: ${figure(level.blocks_touched)}` : '').join('')));
        if (!texture.source) return element('figure', {}, caption);
        const picture = element('img', {src: texture.source, alt: `Blocks touched of ${texture.name}`, width: texture.width, height: texture.height});
        picture.style.width = `${texture.width * Math.max(1, Math.floor(256 / texture.width))}px`;
        return element('figure', {}, picture, caption);
    });
    byId('residency').replaceChildren(...figures);
    showLegend(byId('residency-legend'), 'Texels touched of a block', 0, 16);
}

for (const [id, fill] of [['textures-setting', fillTextures], ['histograms-setting', fillHistograms], ['residency-setting', fillResidency]]) {
    byId(id).append(...settingNames.map(name => element('option', {}, name)));
    byId(id).addEventListener('change', fill);
    fill();
}
for (const label of document.querySelectorAll('.setting-choice')) label.hidden = numbers.length === 1;

// --- What was skipped; times

const geometry = data.geometry;
const sum = (list, read) => list.reduce((total, one) => total + read(one), 0);
const unread = data.textures.filter(texture => texture.texels_requested === 0).length;
fillTable(byId('skipped'), [{key: 'what', label: 'What'}, {key: 'of', label: 'of'}, {key: 'skipped', label: 'Skipped'}, {key: 'why', label: 'Why'}], [
    {what: 'triangles', of: geometry.triangles, skipped: geometry.culled_frustum, why: 'outside the view'},
    {what: 'triangles', of: geometry.triangles, skipped: geometry.culled_backface, why: 'seen from behind'},
    {what: 'triangles', of: geometry.triangles, skipped: geometry.culled_degenerate, why: 'without area after snapping'},
    {what: 'triangles', of: geometry.triangles, skipped: geometry.culled_small, why: 'between all points that the pixel filter may sample'},
    {what: 'triangles', of: geometry.triangles, skipped: geometry.culled_unsampled, why: 'between the points that this frame samples'},
    {what: 'triangles', of: geometry.triangles, skipped: geometry.culled_occluded, why: 'of clusters behind what large opaque clusters cover'},
    {what: 'triangles', of: geometry.triangles, skipped: geometry.culled_nonfinite, why: 'a vertex that is not a number'},
    {what: 'triangles or blocks of tiles', of: null, skipped: geometry.hiz_rejected, why: 'hidden by what a tile holds already'},
    {what: 'tiles', of: geometry.tiles, skipped: geometry.tiles_empty, why: 'no triangle in them'},
    {what: 'textures', of: data.textures.length, skipped: unread, why: 'nothing of them is looked up: no more than their headers was read'},
    {what: 'blocks of textures', of: sum(data.textures, t => t.blocks_total), skipped: sum(data.textures, t => t.blocks_total - t.performed.blocks_decoded - t.performed.blocks_decoded_mips), why: 'never looked up, so not decoded or made'},
]);
fillTable(byId('times'), [{key: 'what', label: 'What'}, {key: 'value', label: 'Value'}, {key: 'unit', label: 'Unit'}], [
    {what: 'frame, geometry to resolved image', value: data.frame_s.median, unit: 's'},
    ...['load', 'geometry', 'raster', 'shade', 'total'].map(key => ({what: key, value: data.time_s[key], unit: 's'})),
    {what: 'textures as stored', value: data.memory_bytes.textures_stored, unit: 'bytes'},
    {what: 'textures decoded', value: data.memory_bytes.textures_decoded, unit: 'bytes'},
]);
byId('frame').textContent = `${width}×${height} pixels, ${data.image.spp} sample${data.image.spp === 1 ? '' : 's'} each; ${data.camera}; cache ${data.fetches.cache}`;

Promise.all([show('left'), show('right')]).then(async () => {
    document.body.dataset.ready = 'yes';
    for (let setting = 0; setting < numbers.length; ++setting)
        for (const name of layers) settled.set(`${setting} ${name}`, await layerValues(setting, name));
    document.body.dataset.readout = 'yes';
});
