// The page of `rawtexel bench`.
'use strict';

const byId = id => document.getElementById(id);
const all = data.configurations;
const kindTitles = {
    'error-samples': 'Error against samples', 'error-time': 'Error against time', 'error-fetches': 'Error against fetches',
    'time-samples': 'Time against samples', 'bias-hybrid': 'Bias against finer levels',
};
const settingName = c => `${c.filter} · ${c.minification} · ${c.estimator} · ${c.order}`;
const samples = count => `${figure(count)} sample${count === 1 ? '' : 's'}`;
const front = c => [c.front_time ? 'time' : '', c.front_fetches ? 'fetches' : ''].filter(Boolean).join(', ');

let scene = 0;
const configurationsOf = index => all.map((c, i) => i).filter(i => all[i].scene === data.scenes[index].scene);
const filtersOf = index => [...new Set(data.scenes[index].plots.map(plot => plot.filter))];

// --- Plots

/** A plot of the program's own, apart from the page's styles; its points speak. */
function plotHost(plot, describe) {
    const host = element('div', {class: 'plot', tabindex: '0', role: 'group', 'aria-label': kindTitles[plot.kind], 'data-kind': plot.kind, 'data-filter': plot.filter});
    const root = host.attachShadow({mode: 'open'});
    root.innerHTML = `<style>svg { display: block; width: 100%; min-width: 34rem; height: auto; } @media print { svg { min-width: 0; } } circle[data-key] { cursor: pointer; } circle.chosen { r: 6px; stroke: #000; stroke-width: 2px; }</style>${plot.svg}`;
    root.querySelector('svg').setAttribute('role', 'img');
    const points = [...root.querySelectorAll('circle[data-key]')];
    let at = -1;
    const choose = index => {
        points[at]?.classList.remove('chosen');
        at = index;
        points[at]?.classList.add('chosen');
        if (at >= 0) describe(points[at].querySelector('title')?.textContent ?? '');
    };
    for (const [i, point] of points.entries()) {
        point.addEventListener('pointerenter', () => choose(i));
        point.addEventListener('click', () => showConfiguration(Number(point.dataset.key)));
    }
    host.addEventListener('keydown', event => {
        const step = {ArrowLeft: -1, ArrowRight: 1}[event.key];
        if (step && points.length) {
            event.preventDefault();
            choose(at < 0 ? (step > 0 ? 0 : points.length - 1) : (at + step + points.length) % points.length);
        } else if (event.key === 'Enter' && at >= 0) {
            showConfiguration(Number(points[at].dataset.key));
        }
    });
    host.addEventListener('blur', () => choose(-1));
    return host;
}

function fillPlots() {
    const filter = byId('filter').value;
    const describe = text => { byId('point').textContent = text; };
    byId('plots').replaceChildren(...data.scenes[scene].plots.filter(plot => plot.filter === filter).map(plot => plotHost(plot, describe)));
    describe('');
}

// --- At a glance

/** What becomes of the errors stands out. */
function findingItem(finding) {
    const parts = finding.text.split(/((?:hits a floor|flattens|falls|as near as this truth can tell|too few numbers to tell):|the fewest fetches at \d+ of \d+ errors?|[\d.]+ times nearer)/);
    return element('li', {'data-kind': finding.kind}, ...parts.map((part, i) => i % 2 ? element('strong', {}, part) : part));
}

function fillGlance() {
    const filter = byId('glance-filter').value;
    byId('glance').replaceChildren(...data.scenes.map(one => {
        const card = element('article', {class: 'card', 'data-scene': one.scene});
        const readout = element('output', {class: 'readout'});
        const plots = element('div', {class: 'plots bench'});
        for (const kind of ['error-samples', 'error-fetches']) {
            const plot = one.plots.find(p => p.kind === kind && p.filter === filter);
            if (plot) plots.append(plotHost(plot, text => { readout.textContent = text; }));
        }
        const findings = one.findings.filter(f => f.filter === filter);
        card.append(element('h3', {}, one.scene), element('ul', {class: 'findings'}, ...findings.map(findingItem)));
        if (plots.children.length) card.append(plots, readout);
        return card;
    }));
}

// --- Pictures

const loaded = new Map();
function picture(source) {
    if (!loaded.has(source)) loaded.set(source, loadPicture(source));
    return loaded.get(source);
}

let slider = null;
let entries = [];  // of the choices: {name, source, command, configuration}

function fillPictures() {
    const truths = data.scenes[scene].truths.map(t => ({name: `truth, ${t.filter}`, source: t.source, command: t.command, filter: t.filter}));
    const measured = configurationsOf(scene).filter(i => all[i].source)
        .map(i => ({name: `${settingName(all[i])}, ${samples(all[i].image.spp)}`, source: all[i].source, command: all[i].command, filter: all[i].filter, configuration: i}));
    entries = [...truths, ...measured];
    for (const side of ['left', 'right']) byId(side).replaceChildren(...entries.map(entry => element('option', {}, entry.name)));
    const size = all[configurationsOf(scene)[0]]?.image;
    byId('pictures').replaceChildren();
    slider = null;
    if (!size) return;
    slider = new Slider(byId('pictures'), size.width, size.height, (x, y) => {
        const text = side => `${byId(side).selectedOptions[0].textContent}: ${slider.codes(side, x, y).join(' ')}`;
        return `pixel ${x}, ${y}\n${text('left')}\n${text('right')}`;
    });
    slider.zoom(Number(byId('zoom').value));
    const first = data.scenes[scene].series[0]?.configurations.at(-1);
    byId('left').selectedIndex = Math.max(0, entries.findIndex(entry => entry.configuration === first));
    byId('right').selectedIndex = 0;
}

async function showPictures() {
    if (!slider) return;
    const chosen = scene;
    const pair = ['left', 'right'].map(side => entries[byId(side).selectedIndex]);
    const shown = await Promise.all(pair.map(entry => picture(entry.source)));
    if (chosen !== scene) return;
    ['left', 'right'].forEach((side, i) => slider.show(side, shown[i], pair[i].name));
    byId('picture-command').textContent = pair.map(entry => entry.command).join('\n');
    document.body.dataset.left = pair[0].name;
}

/** A configuration on the left, the truth of its kernel on the right. */
function showConfiguration(index) {
    const at = entries.findIndex(entry => entry.configuration === index);
    if (at < 0) {
        byId('picture-command').textContent = `${all[index].picture}\n${all[index].command}`;
        return;
    }
    byId('left').selectedIndex = at;
    byId('right').selectedIndex = entries.findIndex(entry => entry.configuration === undefined && entry.filter === all[index].filter);
    showPictures();
}

// --- Tables

const columns = [
    {key: 'setting', label: 'Setting'},
    {key: 'spp', label: 'Samples'},
    {key: 'rmse', label: 'RMSE', best: 'least'},
    {key: 'clear', label: 'Clear', title: 'at least three times the truth’s standard error'},
    {key: 'relmse', label: 'relMSE', best: 'least', title: 'mean of the squared error over the squared truth + 0.01'},
    {key: 'psnr', label: 'PSNR, dB', best: 'most', title: 'for a peak of 1'},
    {key: 'flip', label: 'FLIP', best: 'least', title: 'mean'},
    {key: 'frame_s', label: 'Frame, s', best: 'least', title: 'median of the timed frames'},
    {key: 'spread', label: 'Spread', title: 'largest less smallest over the median'},
    {key: 'geometry', label: 'Geometry, s'},
    {key: 'raster', label: 'Raster, s', title: 'summed over threads'},
    {key: 'shade', label: 'Shade, s', title: 'summed over threads'},
    {key: 'texels_per_pixel', label: 'Texels a pixel', best: 'least', title: 'demanded reads, with repeats'},
    {key: 'lines_per_pixel', label: 'Lines a pixel', best: 'least', title: 'distinct 64-byte lines within the pixel'},
    {key: 'front', label: 'Front'},
];

function fillConfigurations(onlyFront) {
    const rows = configurationsOf(scene).map(i => all[i]).filter(c => !onlyFront || c.front_time || c.front_fetches).map(c => ({
        setting: settingName(c), spp: c.image.spp, rmse: c.rmse, clear: c.clear ? 'yes' : 'no', relmse: c.relmse, psnr: c.psnr, flip: c.flip,
        frame_s: c.frame_s.median, spread: c.frame_s.spread, geometry: c.time_s.geometry, raster: c.time_s.raster, shade: c.time_s.shade,
        texels_per_pixel: c.texels_per_pixel, lines_per_pixel: c.lines_per_pixel, front: front(c) || '–',
    }));
    fillTable(byId('configurations'), columns, rows);
    byId('show-all').setAttribute('aria-pressed', String(!onlyFront));
    byId('show-front').setAttribute('aria-pressed', String(onlyFront));
}

/** Where a series first gets to an error: its cost there, by `read` of a configuration; null where it does not. */
function costAt(series, error, read) {
    const points = series.configurations.map(i => all[i]);
    const at = points.findIndex(c => c.rmse !== null && c.rmse <= error);
    if (at < 0) return null;
    const cost = read(points[at]);
    if (at === 0 || points[at].rmse === error || points[at].rmse === 0 || points[at - 1].rmse === null) return cost;
    const share = Math.log(points[at - 1].rmse / error) / Math.log(points[at - 1].rmse / points[at].rmse);
    return read(points[at - 1]) * (cost / read(points[at - 1])) ** share;
}

function fillReached() {
    const error = Number(byId('reach').value);
    const rows = data.scenes[scene].series.map(s => ({
        name: s.name, texels: costAt(s, error, c => c.texels_per_pixel), time: costAt(s, error, c => c.frame_s.median), samples: costAt(s, error, c => c.image.spp),
    })).filter(row => row.texels !== null).sort((a, b) => a.texels - b.texels);
    fillTable(byId('reached'), [
        {key: 'name', label: 'Setting'}, {key: 'texels', label: 'Texels a pixel', best: 'least'}, {key: 'time', label: 'Frame, s', best: 'least'},
        {key: 'samples', label: 'Samples'},
    ], rows);
    byId('reached-none').hidden = rows.length > 0;
}

function fillScene() {
    const one = data.scenes[scene];
    byId('scene-name').textContent = byId('reach-scene').textContent = one.scene;
    const last = one.series.map(s => all[s.configurations.at(-1)].rmse).filter(rmse => rmse !== null).sort((a, b) => a - b);
    byId('reach').value = last.length ? String(Number((last[Math.floor(last.length / 2)] / 2).toPrecision(2))) : '0';
    fillReached();
    const kept = byId('filter').length ? byId('filter').value : null;
    const filters = filtersOf(scene);
    byId('filter').replaceChildren(...filters.map(f => element('option', {value: f}, f || 'all beside each other')));
    if (filters.includes(kept)) byId('filter').value = kept;
    fillPlots();
    fillPictures();
    fillConfigurations(byId('show-front').getAttribute('aria-pressed') === 'true');
    fillTable(byId('series'), [
        {key: 'name', label: 'Setting'}, {key: 'trend', label: 'Trend'}, {key: 'slope', label: 'Slope'}, {key: 'bias', label: 'Bias', title: 'RMSE that samples do not lower'},
        {key: 'points', label: 'Numbers of samples'},
    ], one.series.map(s => ({name: s.name, trend: s.trend, slope: s.slope, bias: s.bias, points: s.configurations.length})));
    fillTable(byId('truths'), [
        {key: 'filter', label: 'Kernel'}, {key: 'spp', label: 'Samples'}, {key: 'standard_error', label: 'Standard error'}, {key: 'goal', label: 'Goal'},
        {key: 'reached', label: 'Reached'}, {key: 'seconds', label: 'Time, s'},
    ], one.truths.map(t => ({...t, reached: t.reached ? 'yes' : 'no'})));
    byId('left-out-section').hidden = one.left_out.length === 0;
    fillTable(byId('left-out'), [{key: 'options', label: 'Options'}, {key: 'spp', label: 'Samples'}, {key: 'reason', label: 'Why'}],
        one.left_out.map(l => ({...l, spp: l.spp.join(', ')})));
    document.body.dataset.scene = one.scene;
    return showPictures();
}

// --- Controls

byId('scene').append(...data.scenes.map(one => element('option', {}, one.scene)));
byId('scene').addEventListener('change', () => { scene = byId('scene').selectedIndex; fillScene(); });
byId('filter').addEventListener('change', fillPlots);
byId('reach').addEventListener('input', fillReached);
const everyFilter = [...new Set(data.scenes.flatMap(one => one.plots.map(plot => plot.filter)))].filter(Boolean);
byId('glance-filter').append(...everyFilter.map(f => element('option', {}, f)));
byId('glance-filter').addEventListener('change', fillGlance);
for (const side of ['left', 'right']) byId(side).addEventListener('change', showPictures);
byId('zoom').addEventListener('change', () => slider?.zoom(Number(byId('zoom').value)));
function swap() {
    const left = byId('left').selectedIndex;
    byId('left').selectedIndex = byId('right').selectedIndex;
    byId('right').selectedIndex = left;
    showPictures();
}
byId('swap').addEventListener('click', swap);
byId('show-all').addEventListener('click', () => fillConfigurations(false));
byId('show-front').addEventListener('click', () => fillConfigurations(true));

document.addEventListener('keydown', event => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target.closest?.('select, input[type=number]')) return;
    const step = (id, by) => {
        const select = byId(id);
        if (!select.length) return;
        select.selectedIndex = (select.selectedIndex + by + select.length) % select.length;
        select.dispatchEvent(new Event('change'));
    };
    const key = event.key.toLowerCase();
    if (key === 'n') step('left', event.shiftKey ? -1 : 1);
    else if (key === 's') swap();
    else if (key === 'z') step('zoom', 1);
});

const size = all[0]?.image;
byId('about').textContent = size ?
    `${figure(all.length)} configurations of ${data.scenes.length} scene${data.scenes.length === 1 ? '' : 's'}, ${size.width}×${size.height} pixels. Errors are of linear radiance, against the truth of each scene and kernel.` :
    'No configuration was measured.';
fillGlance();
fillScene().then(() => { document.body.dataset.ready = 'yes'; });
