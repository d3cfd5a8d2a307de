/**
 * Elements without markup: texts are always set as text, so a name such as `<script>` is shown and not run.
 */

/**
 * An element with attributes, listeners (`onclick`) and children.
 * @param {string} name
 * @param {Record<string, any>} [attributes] `null`, `undefined` and `false` are left out, `true` is an empty attribute.
 * @param {...(Node|string|number|null)} children
 * @returns {any}
 */
export function element(name, attributes = {}, ...children) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (value === null || value === undefined || value === false) continue;
    if (key.startsWith('on')) made.addEventListener(key.slice(2), value);
    else if (key === 'value') /** @type {any} */ (made).value = value;
    else made.setAttribute(key, value === true ? '' : String(value));
  }
  made.append(...children.filter((child) => child !== null).map((child) => (typeof child === 'number' ? String(child) : child)));
  return made;
}

/** What went wrong, in words. @param {unknown} error */
export const messageOf = (error) => (error instanceof Error ? error.message : String(error));

/** @param {string} id @returns {any} the page's element of that id */
export const byId = (id) => document.getElementById(id);

/**
 * A labelled choice.
 * @param {string} label
 * @param {(string|string[])[]} options values, or pairs of value and title
 * @param {string} chosen
 * @param {(value: string) => void} change
 */
export function choice(label, options, chosen, change) {
  const pairs = options.map((option) => (Array.isArray(option) ? option : [option, option]));
  if (!pairs.some(([value]) => value === chosen)) pairs.push([chosen, chosen]);
  const select = element('select', { onchange: () => change(select.value) },
    ...pairs.map(([value, title]) => element('option', { value }, title)));
  select.value = chosen;
  return element('label', { class: 'field' }, element('span', {}, label), select);
}

/** What a control is called: its key, or what a reader hears, and the texture unit that it belongs to. @param {HTMLElement} control */
function nameOf(control) {
  const { key, define, file } = control.dataset;
  const label = control.getAttribute('aria-label') ?? (control.closest('label')?.querySelector('span') ?? control).textContent;
  return JSON.stringify([control.closest('[data-unit]')?.getAttribute('data-unit'), key ?? define ?? file ?? label]);
}

/**
 * Gives an element other children. The keyboard's focus stays on the control of the same name, else on that at its place.
 * @param {HTMLElement} parent
 * @param {...Node} children
 */
export function replaceChildren(parent, ...children) {
  const controls = () => /** @type {HTMLElement[]} */ ([...parent.querySelectorAll('button, select, input')]);
  const active = /** @type {HTMLElement} */ (document.activeElement);
  const before = controls(), at = before.indexOf(active);
  const name = at >= 0 && nameOf(active), same = before.filter((control) => nameOf(control) === name).indexOf(active);
  parent.replaceChildren(...children);
  if (at < 0) return;
  const after = controls();
  (after.filter((control) => nameOf(control) === name)[same] ?? after[at])?.focus();
}

/**
 * Puts pixels into a canvas of their size.
 * @param {HTMLCanvasElement} canvas
 * @param {Uint8Array} pixels RGBA8, rows from the top
 * @param {number} width
 * @param {number} height
 */
export function paint(canvas, pixels, width, height) {
  canvas.width = width;
  canvas.height = height;
  const image = new ImageData(new Uint8ClampedArray(pixels), width, height);
  canvas.getContext('2d')?.putImageData(image, 0, 0);
}

/**
 * A function that runs once the calls to it have paused.
 * @param {number} milliseconds
 * @param {() => void} run
 * @returns {(() => void) & {cancel: () => void}}
 */
export function afterPause(milliseconds, run) {
  /** @type {ReturnType<typeof setTimeout>|undefined} */
  let timer;
  const later = () => {
    clearTimeout(timer);
    timer = setTimeout(run, milliseconds);
  };
  later.cancel = () => clearTimeout(timer);
  return later;
}

/**
 * A function that runs once before the next frame, however often it is called; where the browser makes no frames, as in
 * a tab that is hidden or a window that is covered, soon.
 * @param {() => void} run
 */
export function nextFrame(run) {
  let waiting = false, frame = 0;
  /** @type {ReturnType<typeof setTimeout>|undefined} */
  let timer;
  const now = () => {
    if (!waiting) return;
    clearTimeout(timer);
    cancelAnimationFrame(frame);
    waiting = false;
    run();
  };
  return () => {
    if (waiting) return;
    waiting = true;
    timer = setTimeout(now, document.hidden ? 0 : 100);
    frame = requestAnimationFrame(now);
  };
}

/** Offers a text as a file. @param {string} name @param {string|Blob} content */
export function save(name, content) {
  const address = URL.createObjectURL(content instanceof Blob ? content : new Blob([content], { type: 'text/plain' }));
  element('a', { href: address, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(address), 1000);
}
