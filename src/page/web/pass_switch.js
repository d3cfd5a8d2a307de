// The passes that drew at a pixel, and the diagram of the one that is chosen.
//
// drawn: {first, passes}; a pass is {name, notes, trace, explanation}. notes: lines about its fragments. trace: the object
// that `ninebit trace --json` prints, missing where there is no program or no fragment to trace. explanation: the object
// that `ninebit explain --json` prints. A trace without a picture is one pass without a name. Texts only ever become text
// nodes.
import { make } from './diagram_elements.js';
import { traceDiagram } from './trace_diagram.js';

export function passSwitch(container, drawn) {
  const list = make('div', 'passes');
  list.setAttribute('role', 'tablist');
  list.setAttribute('aria-label', 'Passes that drew here, in their order');
  const shown = make('div');
  shown.id = 'pass';
  shown.setAttribute('role', 'tabpanel');
  const tabs = drawn.passes.map((pass, at) => {
    const tab = make('button', '', `${at + 1}. ${pass.name}`);
    tab.type = 'button';
    tab.setAttribute('role', 'tab');
    tab.setAttribute('aria-controls', shown.id);
    tab.addEventListener('click', () => choose(at));
    list.append(tab);
    return tab;
  });
  list.addEventListener('keydown', (event) => {
    const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (!step) return;
    event.preventDefault();
    choose((tabs.indexOf(document.activeElement) + step + tabs.length) % tabs.length).focus();
  });
  function choose(at) {
    tabs.forEach((tab, number) => {
      tab.setAttribute('aria-selected', String(number === at));
      tab.tabIndex = number === at ? 0 : -1;
    });
    const { notes, trace, explanation } = drawn.passes[at];
    const diagram = make('div');
    shown.replaceChildren(...(notes ?? []).map((note) => make('p', 'note', note)), diagram);
    if (trace) traceDiagram(diagram, trace, { explanation });
    return tabs[at];
  }
  if (drawn.passes[0].name !== undefined) container.replaceChildren(list, shown);
  else container.replaceChildren(shown);
  choose(drawn.first);
}
