/** As much of a document as controls need in Node: elements in a tree, found by a tag, a class or `data-…`, that hear of events. */
class SmallElement {
  constructor(localName) {
    Object.assign(this, { localName, children: [], attributes: {}, dataset: {}, listeners: {}, value: '', hidden: false });
  }

  setAttribute(name, value) {
    this.attributes[name] = value;
    if (name.startsWith('data-')) this.dataset[name.slice('data-'.length)] = value;
  }

  getAttribute(name) { return this.attributes[name] ?? null; }
  removeAttribute(name) { delete this.attributes[name]; }
  closest() { return null; }
  addEventListener(event, run) { this.listeners[event] = run; }
  append(...children) { this.children.push(...children.filter((child) => child instanceof SmallElement)); }
  replaceChildren(...children) { this.children = children; }
  contains(other) { return this.children.some((child) => child === other || child.contains(other)); }
  focus() { globalThis.document.activeElement = this; }

  fits(selector) {
    return selector.startsWith('.') ? (this.attributes.class ?? '').split(' ').includes(selector.slice(1)) : this.localName === selector;
  }

  querySelectorAll(selectors) {
    const all = selectors.split(', ');
    return this.children.flatMap((child) => [...all.some((one) => child.fits(one)) ? [child] : [], ...child.querySelectorAll(selectors)]);
  }

  querySelector(selectors) { return this.querySelectorAll(selectors)[0] ?? null; }
}

globalThis.document = { createElement: (name) => new SmallElement(name), activeElement: null };

/** An element that is in no tree. */
export const made = (name) => globalThis.document.createElement(name);

/** Types or chooses a value as a person does. */
export function enter(control, value) {
  control.value = value;
  (control.listeners.input ?? control.listeners.change)();
}
