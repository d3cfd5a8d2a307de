/**
 * Tabs by the rules of ARIA: the arrow keys move between them, Tab enters the panel.
 */

/**
 * @param {HTMLElement} list the element of role tablist
 * @param {(name: string) => void} shown hears which panel is now seen
 * @returns {(name: string) => void} shows a panel
 */
export function tabs(list, shown) {
  const buttons = /** @type {HTMLButtonElement[]} */ ([...list.querySelectorAll('[role=tab]')]);
  const panel = (/** @type {Element} */ button) => /** @type {HTMLElement} */ (document.getElementById(button.getAttribute('aria-controls') ?? ''));
  const choose = (/** @type {HTMLButtonElement} */ chosen) => {
    for (const button of buttons) {
      const selected = button === chosen;
      button.setAttribute('aria-selected', String(selected));
      button.tabIndex = selected ? 0 : -1;
      panel(button).hidden = !selected;
    }
    shown(chosen.dataset.panel ?? '');
  };
  buttons.forEach((button, at) => {
    button.addEventListener('click', () => choose(button));
    button.addEventListener('keydown', (event) => {
      const step = event.key === 'ArrowRight' ? 1 : event.key === 'ArrowLeft' ? -1 : 0;
      if (!step) return;
      const next = buttons[(at + step + buttons.length) % buttons.length];
      next.focus();
      choose(next);
    });
  });
  return (name) => choose(buttons.find((button) => button.dataset.panel === name) ?? buttons[0]);
}
