// The page of `rawtexel compare --html`.
'use strict';

const byId = id => document.getElementById(id);
const views = [{key: 'picture', label: 'Pictures'}, {key: 'absolute', label: 'Absolute difference'}, {key: 'flip', label: 'FLIP'}]
    .filter(view => view.key === 'picture' || data.pictures.some(picture => picture[view.key]));
const names = shortNames(data.pictures.map(p => p.name));
let view = 'picture';
let timer = 0;

const loaded = new Map();
function picture(source) {
    if (!loaded.has(source)) loaded.set(source, loadPicture(source));
    return loaded.get(source);
}

const slider = new Slider(byId('pictures'), data.width, data.height, (x, y) => {
    const text = side => `${byId(side).selectedOptions[0].textContent}: ${slider.codes(side, x, y).join(' ')}`;
    return `pixel ${x}, ${y}\n${text('left')}   ${text('right')}`;
});

/** A map of the reference against itself says nothing: its picture stands beside the other's map. */
async function show() {
    await Promise.all(['left', 'right'].map(async side => {
        const chosen = data.pictures[byId(side).selectedIndex], name = names[byId(side).selectedIndex];
        const source = chosen[view] ?? chosen.picture;
        const shown = await picture(source);
        slider.show(side, shown, chosen[view] && view !== 'picture' ? `${name}: ${views.find(v => v.key === view).label}` : name);
    }));
    for (const button of byId('views').children) button.setAttribute('aria-pressed', String(button.dataset.view === view));
    byId('legend').hidden = view === 'picture';
    if (view === 'absolute') showLegend(byId('legend'), 'Largest difference of a pixel’s channels', 0, data.absolute_range);
    if (view === 'flip') showLegend(byId('legend'), 'FLIP error', 0, 1);
    document.body.dataset.view = view;
}

function choose(side, index) {
    byId(side).selectedIndex = index;
    return show();
}

function swap() {
    const left = byId('left').selectedIndex;
    byId('left').selectedIndex = byId('right').selectedIndex;
    return choose('right', left);
}

/** In turns at the same place, which is how FLIP's observer looks. */
function alternate() {
    const running = timer !== 0;
    clearInterval(timer);
    timer = running ? 0 : setInterval(() => slider.moveTo(slider.position < 50 ? 100 : 0), 600);
    slider.pinned = !running;
    byId('alternate').setAttribute('aria-pressed', String(!running));
    if (running) slider.moveTo(50);
}

for (const side of ['left', 'right']) {
    byId(side).append(...names.map(name => element('option', {}, name)));
    byId(side).addEventListener('change', show);
}
byId('right').selectedIndex = data.pictures.findIndex(p => p.reference);
byId('views').append(...views.map(v => element('button', {
    type: 'button', 'data-view': v.key, on: {click: () => { view = v.key; show(); }},
}, v.label)));
byId('zoom').addEventListener('change', () => slider.zoom(Number(byId('zoom').value)));
byId('swap').addEventListener('click', swap);
byId('alternate').addEventListener('click', alternate);

document.addEventListener('keydown', event => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target.closest('select')) return;
    const key = event.key.toLowerCase();
    if (key === 's') swap();
    else if (key === 'a') alternate();
    else if (key === 'm') { view = views[(views.findIndex(v => v.key === view) + 1) % views.length].key; show(); }
    else if (key === 'z') { byId('zoom').selectedIndex = (byId('zoom').selectedIndex + 1) % byId('zoom').length; byId('zoom').dispatchEvent(new Event('change')); }
    else if (/^[1-9]$/.test(key) && Number(key) <= data.pictures.length) choose('left', Number(key) - 1);
});

const columns = [
    {key: 'image', label: 'Image'},
    {key: 'mse', label: 'MSE', best: 'least', title: 'mean squared error'},
    {key: 'rmse', label: 'RMSE', best: 'least', title: 'root of the mean squared error'},
    {key: 'psnr', label: 'PSNR, dB', best: 'most', title: 'for a peak of 1; none for equal images'},
    {key: 'relmse', label: 'relMSE', best: 'least', title: 'mean of the squared error over the squared reference + 0.01'},
    {key: 'max', label: 'Max', best: 'least', title: 'largest absolute difference'},
    {key: 'mean', label: 'Mean', best: 'least', title: 'mean absolute difference'},
    {key: 'flip', label: 'FLIP', best: 'least', title: 'mean FLIP error'},
    {key: 'flip_q1', label: 'quartile 1', title: 'weighted by error'},
    {key: 'flip_median', label: 'median', title: 'weighted by error'},
    {key: 'flip_q3', label: 'quartile 3', title: 'weighted by error'},
    {key: 'flip_min', label: 'min'},
    {key: 'flip_max', label: 'max'},
    {key: 'flip_kind', label: 'kind'},
].filter(column => data.images.some(image => column.key in image));
fillTable(byId('figures'), columns, data.images);

const first = data.images[0];
const notes = [];
if (data.tone_mapped) notes.push('Linear light is shown under ACES at exposure 0; the figures are of the light itself.');
if (first.flip_kind) notes.push(`FLIP at ${figure(first.flip_pixels_per_degree)} pixels per degree; quartiles and median are weighted by error.`);
const hdr = data.images.find(image => image.flip_exposures);
if (hdr) notes.push(`HDR: the worst of ${hdr.flip_exposures.count} exposures from ${figure(hdr.flip_exposures.start)} to ${figure(hdr.flip_exposures.stop)} stops.`);
byId('notes').textContent = notes.join(' ');

show().then(() => { document.body.dataset.ready = 'yes'; });
