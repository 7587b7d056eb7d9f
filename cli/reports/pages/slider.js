// Two pictures over each other with a line between them that pointer and keyboard move.
'use strict';

class Slider {
    /**
     * Builds itself into `place`: the pictures, the range that moves the line, and a read-out of the pixel under the pointer.
     * `describe(x, y)` gives the text of a pixel.
     */
    constructor(place, width, height, describe) {
        this.width = width;
        this.height = height;
        this.left = element('canvas', {width, height, class: 'left-picture'});
        this.right = element('canvas', {width, height, class: 'right-picture'});
        this.over = element('div', {class: 'over'}, this.left);
        this.divider = element('div', {class: 'divider'});
        this.leftTag = element('div', {class: 'tag left'});
        this.rightTag = element('div', {class: 'tag right'});
        this.stage = element('div', {class: 'stage'}, this.right, this.over, this.divider, this.leftTag, this.rightTag);
        this.box = element('div', {class: 'slider', tabindex: '0', role: 'group', 'aria-label': 'Pictures'}, this.stage);
        this.range = element('input', {
            type: 'range', class: 'slider-position', min: '0', max: '100', step: '0.5', value: '50', 'aria-label': 'Where the left picture ends, percent',
        });
        this.readout = element('output', {class: 'readout'});
        place.replaceChildren(this.box, this.range, this.readout);

        this.range.addEventListener('input', () => this.moveTo(Number(this.range.value)));
        this.stage.addEventListener('pointermove', event => this.point(event, describe));
        this.stage.addEventListener('pointerdown', event => this.point(event, describe, true));
        this.box.addEventListener('keydown', event => {
            const step = {ArrowLeft: -1, ArrowRight: 1, Home: -1000, End: 1000}[event.key];
            if (!step || event.ctrlKey || event.metaKey || event.altKey) return;
            event.preventDefault();
            this.moveTo(this.position + step * (event.shiftKey ? 10 : 1));
        });
        this.zoom(0);
        this.moveTo(50);
    }

    /** `percent` of the width shows the left picture. */
    moveTo(percent) {
        this.position = Math.min(100, Math.max(0, percent));
        this.range.value = String(this.position);
        this.over.style.clipPath = `inset(0 ${100 - this.position}% 0 0)`;
        this.divider.style.left = `${this.position}%`;
        this.divider.hidden = this.position <= 0 || this.position >= 100;
    }

    /** The pixel under the pointer is told; the line follows a pressed pointer, and a mouse by itself unless it is pinned. */
    point(event, describe, pressed = false) {
        const box = this.stage.getBoundingClientRect();
        const u = (event.clientX - box.left) / box.width, v = (event.clientY - box.top) / box.height;
        if (u < 0 || u >= 1 || v < 0 || v >= 1) return;
        this.readout.textContent = describe(Math.floor(u * this.width), Math.floor(v * this.height));
        if (pressed || event.buttons || (event.pointerType === 'mouse' && !this.pinned)) this.moveTo(u * 100);
    }

    /** Pictures are canvases or images of the slider's extents. */
    show(side, picture, name) {
        const context = this[side].getContext('2d', {willReadFrequently: true});
        context.clearRect(0, 0, this.width, this.height);
        context.drawImage(picture, 0, 0);
        this[`${side}Tag`].textContent = name;
    }

    codes(side, x, y) { return [...this[side].getContext('2d', {willReadFrequently: true}).getImageData(x, y, 1, 1).data.slice(0, 3)]; }

    /** 0 fits the window, otherwise screen pixels (CSS) a pixel. Pixels that are magnified stay squares. */
    zoom(scale) {
        this.stage.style.width = scale ? `${this.width * scale}px` : `min(100%, ${80 * this.width / this.height}vh)`;
        const sharpen = () => this.box.classList.toggle('exact', this.stage.clientWidth >= this.width);
        this.resized ??= new ResizeObserver(sharpen);
        this.resized.observe(this.stage);
        sharpen();
    }
}
