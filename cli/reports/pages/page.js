// What all pages share: the data that the program wrote, numbers as text, tables and the colours of maps.
'use strict';

const data = JSON.parse(document.getElementById('data').textContent);

/** An element with attributes and children; text stays text. */
function element(name, attributes = {}, ...children) {
    const made = document.createElement(name);
    for (const [key, value] of Object.entries(attributes)) {
        if (key === 'on') for (const [event, listener] of Object.entries(value)) made.addEventListener(event, listener);
        else if (value === true) made.setAttribute(key, '');
        else if (value !== false && value !== undefined && value !== null) made.setAttribute(key, value);
    }
    made.append(...children);
    return made;
}

/** Six digits, as the program prints them; null is what JSON has for infinite and missing numbers. */
function figure(value) {
    if (value === null || value === undefined) return '–';
    if (typeof value !== 'number') return String(value);
    if (Number.isInteger(value)) return value.toLocaleString('en').replaceAll(',', '\u202f');
    return String(Number(value.toPrecision(6)));
}

/**
 * Fills `table` with rows of objects. A column is {key, label, best: 'least' | 'most'}; a click on its heading sorts by it.
 * Every cell of a number carries it whole as data-value.
 */
function fillTable(table, columns, rows) {
    const best = new Map();
    for (const column of columns.filter(c => c.best)) {
        const values = rows.map(row => row[column.key]).filter(v => typeof v === 'number');
        if (rows.length > 1 && values.length) best.set(column.key, column.best === 'least' ? Math.min(...values) : Math.max(...values));
    }
    let order = [...rows];
    let sorted = null, descending = false;
    const sortBy = column => {
        descending = sorted === column.key ? !descending : false;
        sorted = column.key;
        const rank = v => v === null || v === undefined ? Infinity : v;
        order = [...rows].sort((a, b) => {
            const x = rank(a[sorted]), y = rank(b[sorted]);
            return (x < y ? -1 : x > y ? 1 : 0) * (descending ? -1 : 1);
        });
        draw();
        table.querySelector(`th[data-key="${CSS.escape(sorted)}"] button`).focus();
    };
    const cell = (row, column) => {
        const value = row[column.key];
        const made = element('td', {'data-key': column.key}, figure(value));
        if (typeof value === 'number') made.setAttribute('data-value', String(value));
        if (best.has(column.key) && value === best.get(column.key)) made.className = 'best';
        return made;
    };
    const draw = () => {
        const head = element('tr', {}, ...columns.map(column => element('th', {
            scope: 'col', 'data-key': column.key, title: column.title,
            'aria-sort': sorted === column.key ? (descending ? 'descending' : 'ascending') : undefined,
        }, element('button', {type: 'button', on: {click: () => sortBy(column)}}, column.label))));
        table.replaceChildren(element('thead', {}, head),
            element('tbody', {}, ...order.map(row => element('tr', {}, ...columns.map(column => cell(row, column))))));
    };
    draw();
}

/** The colours of maps as bytes, 256 of them. */
const mapColours = Uint8ClampedArray.from((data.colour_map ?? '').match(/../g) ?? [], pair => parseInt(pair, 16));

/** A bar of the map's colours with what its ends mean. */
function showLegend(place, label, low, high) {
    const stops = [];
    for (let i = 0; i <= 16; ++i) {
        const at = Math.round(i * 255 / 16) * 3;
        stops.push(`rgb(${mapColours[at]} ${mapColours[at + 1]} ${mapColours[at + 2]})`);
    }
    const bar = element('div', {class: 'bar'});
    bar.style.background = `linear-gradient(to right, ${stops.join(', ')})`;
    place.replaceChildren(element('div', {}, label), bar,
        element('div', {class: 'ends'}, element('span', {'data-value': String(low)}, figure(low)),
            element('span', {'data-value': String(high)}, figure(high))));
}

/** Paths without the folders that all of them begin with. */
function shortNames(paths) {
    const folders = paths.map(path => path.split('/').slice(0, -1));
    let shared = 0;
    while (folders.every(parts => parts.length > shared && parts[shared] === folders[0][shared])) ++shared;
    return paths.map(path => path.split('/').slice(shared).join('/'));
}

/** The picture behind a data address. */
async function loadPicture(source) {
    const picture = new Image();
    picture.src = source;
    await picture.decode();
    return picture;
}

for (const place of document.querySelectorAll('[data-text]')) {
    let value = data;
    for (const key of place.dataset.text.split('.')) value = value?.[key];
    place.textContent = value ?? '';
}
