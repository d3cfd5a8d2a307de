// The style of the diagram, which its first use adds to the document. Colours follow the scheme of the reader.
export const kDiagramStyle = `
.nb-diagram {
  --nb-paper: #fcfbf9; --nb-box: #ffffff; --nb-ink: #1d1d1b; --nb-quiet: #62605b; --nb-rule: #d5d1c8; --nb-wire: #b0aba0;
  --nb-accent: #2b5c8f; --nb-accent-soft: #e7eff8; --nb-trunc: #8a5a00; --nb-trunc-soft: #fdf1d8; --nb-clamp: #b3261e;
  --nb-clamp-soft: #fbe6e4; --nb-in: #f1f5ee; --nb-in-rule: #9cb38a; --nb-op: #f6f3fb; --nb-op-rule: #b9a9d6;
  --nb-mono: ui-monospace, "SF Mono", "Cascadia Mono", Menlo, Consolas, "DejaVu Sans Mono", monospace;
  color: var(--nb-ink); font: 13px/1.35 system-ui, -apple-system, "Segoe UI", Roboto, "Noto Sans", "DejaVu Sans", sans-serif;
  text-align: left; border: 1px solid var(--nb-rule); border-radius: 8px; background: var(--nb-paper); overflow: hidden;
  min-width: 0; max-width: 100%; display: flex; flex-direction: column; }
@media (prefers-color-scheme: dark) { .nb-diagram {
  --nb-paper: #16181b; --nb-box: #1e2124; --nb-ink: #e7e5e0; --nb-quiet: #a19f99; --nb-rule: #3b3f44; --nb-wire: #62676d;
  --nb-accent: #8fbbe8; --nb-accent-soft: #20303f; --nb-trunc: #f0be5a; --nb-trunc-soft: #372c14; --nb-clamp: #ff9b91;
  --nb-clamp-soft: #40201d; --nb-in: #1c241b; --nb-in-rule: #5d7a4e; --nb-op: #231f2c; --nb-op-rule: #6b5c8a; } }
.nb-diagram *, .nb-diagram *::before { box-sizing: border-box; }
.nb-bar { display: flex; flex-wrap: wrap; align-items: center; gap: 6px 8px; padding: 8px 10px; background: var(--nb-box);
  border-bottom: 1px solid var(--nb-rule); }
.nb-bar button { font: inherit; color: inherit; background: var(--nb-paper); border: 1px solid var(--nb-rule); border-radius: 6px;
  min-width: 34px; height: 32px; padding: 0 10px; cursor: pointer; }
.nb-bar button:hover:not(:disabled) { border-color: var(--nb-accent); }
.nb-bar button:disabled { opacity: .4; cursor: default; }
.nb-bar input[type=range] { flex: 1 1 110px; min-width: 80px; max-width: 260px; accent-color: var(--nb-accent); }
.nb-step { color: var(--nb-quiet); font-variant-numeric: tabular-nums; white-space: nowrap; }
.nb-legend { display: flex; flex-wrap: wrap; gap: 2px 14px; margin-left: auto; color: var(--nb-quiet); font-size: 12px; }
.nb-legend b:not([class]) { color: var(--nb-ink); font-weight: 600; }
.nb-said { padding: 7px 12px; min-height: 3.9em; border-bottom: 1px solid var(--nb-rule); background: var(--nb-box);
  font-variant-numeric: tabular-nums; overflow-wrap: anywhere; }
.nb-said .nb-place { color: var(--nb-quiet); margin-right: .6em; }
.nb-said .nb-value { font-family: var(--nb-mono); font-size: 12px; margin-right: 1.1em; white-space: nowrap; }
.nb-said .nb-value i { font-style: normal; color: var(--nb-quiet); }
.nb-scroll { overflow: auto; max-height: var(--nb-max-height, none); position: relative; }
.nb-scroll:focus-visible { outline: 2px solid var(--nb-accent); outline-offset: -2px; }
.nb-sheet { position: relative; margin: 0 auto; }
.nb-wires { position: absolute; inset: 0; pointer-events: none; }
.nb-wires path { fill: none; stroke: var(--nb-wire); stroke-width: 1.5; transition: opacity .12s; }
.nb-wires path.nb-hold { stroke: transparent; stroke-width: 9; pointer-events: stroke; cursor: pointer; }
.nb-wires path.nb-refused { stroke-dasharray: 3 4; opacity: .65; }
.nb-section { position: absolute; margin: 0; }
.nb-section h3 { margin: 0; font-size: 15px; line-height: 22px; letter-spacing: -.005em; background: var(--nb-paper);
  display: inline-block; padding-right: 10px; }
.nb-column { position: absolute; color: var(--nb-quiet); font-size: 11px; line-height: 14px; white-space: nowrap;
  border-top: 1px solid var(--nb-rule); padding-top: 3px; }
.nb-column .nb-cell { padding: 0 8px; font-size: 10px; grid-template-columns: 20px 10px 1fr 9.66ch 9.66ch; }
.nb-note { position: absolute; color: var(--nb-quiet); font-style: italic; overflow-wrap: anywhere; }
.nb-box { position: absolute; background: var(--nb-box); border: 1px solid var(--nb-rule); border-radius: 6px; overflow: hidden;
  transition: opacity .12s; }
.nb-box > header { display: block; height: 39px; padding: 3px 8px; overflow: hidden; position: relative; }
.nb-box > header b { display: block; font-weight: 600; font-size: 12.5px; line-height: 17px; white-space: nowrap;
  overflow: hidden; text-overflow: ellipsis; }
.nb-box > header small { display: block; color: var(--nb-quiet); font-size: 11px; line-height: 15px; white-space: nowrap;
  overflow: hidden; text-overflow: ellipsis; }
.nb-register { background: var(--nb-in); border-color: var(--nb-in-rule); }
.nb-operator, .nb-stage { background: var(--nb-op); border-color: var(--nb-op-rule); }
.nb-operator > header { padding-right: 34px; }
.nb-symbol { position: absolute; right: 7px; top: 7px; width: 24px; height: 24px; border: 1.5px solid var(--nb-op-rule);
  border-radius: 50%; text-align: center; line-height: 20px; font-size: 15px; }
.nb-symbol.nb-long { font-size: 10px; }
.nb-output, .nb-result { border-left-width: 3px; border-left-color: var(--nb-accent); }
.nb-result { border-width: 2px; border-color: var(--nb-accent); }
.nb-swatch { position: absolute; right: 8px; top: 8px; width: 22px; height: 22px; border-radius: 4px; border: 1px solid var(--nb-rule); }
.nb-caption { height: 17px; padding: 0 8px; font-size: 11px; line-height: 17px; color: var(--nb-quiet); display: flex;
  justify-content: space-between; white-space: nowrap; }
.nb-caption .nb-mark { font-weight: 600; }
.nb-cell { display: grid; grid-template-columns: 20px 10px 1fr 9.2ch 9.2ch; height: 16px; padding: 0 7px; font: 10.5px/16px var(--nb-mono);
  text-align: right; cursor: default; white-space: pre; transition: opacity .12s; }
.nb-cell.nb-single { grid-template-columns: 24px 10px 1fr; }
.nb-cell.nb-word { display: block; text-align: left; }
.nb-cell.nb-word .nb-glyph { display: none; }
.nb-equation { position: absolute; font: 600 12.5px/20px var(--nb-mono); overflow-wrap: anywhere; white-space: pre-wrap; }
.nb-equation i { font-weight: 400; color: var(--nb-quiet); }
.nb-cell:focus { outline: 2px solid var(--nb-accent); outline-offset: -2px; border-radius: 3px; }
.nb-cell span:first-child { text-align: left; color: var(--nb-quiet); }
.nb-cell .nb-held { font-weight: 700; }
.nb-cell .nb-real { color: var(--nb-quiet); }
.nb-cell .nb-ideal { color: var(--nb-quiet); }
.nb-cell.nb-differs .nb-ideal { color: var(--nb-ink); text-decoration: underline dotted; text-underline-offset: 2px; }
.nb-truncated { color: var(--nb-trunc); }
.nb-cell.nb-truncated { background: var(--nb-trunc-soft); color: inherit; }
.nb-cell.nb-truncated .nb-glyph { color: var(--nb-trunc); }
.nb-clamped { color: var(--nb-clamp); }
.nb-cell.nb-clamped { background: var(--nb-clamp-soft); color: inherit; }
.nb-cell.nb-clamped .nb-glyph { color: var(--nb-clamp); }
.nb-box.nb-pending { opacity: .16; }
.nb-wires path.nb-pending { opacity: .12; }
.nb-box.nb-current { border-color: var(--nb-accent); box-shadow: 0 0 0 3px var(--nb-accent-soft), 0 0 0 1.5px var(--nb-accent); }
.nb-tracing .nb-box:not(.nb-lit) { opacity: .2; }
.nb-tracing .nb-wires path:not(.nb-lit) { opacity: .1; }
.nb-tracing .nb-box.nb-lit { opacity: 1; border-color: var(--nb-accent); }
.nb-tracing .nb-box.nb-lit .nb-cell:not(.nb-lit), .nb-tracing .nb-box.nb-lit .nb-caption { opacity: .32; }
.nb-tracing .nb-cell.nb-lit { opacity: 1; }
.nb-box:focus { outline: none; }
.nb-tracing .nb-box.nb-chosen { box-shadow: 0 0 0 2px var(--nb-accent); }
.nb-tracing .nb-cell.nb-chosen { background: var(--nb-accent); color: var(--nb-paper); border-radius: 3px; }
.nb-tracing .nb-cell.nb-chosen span { color: inherit; }
.nb-tracing .nb-wires path.nb-lit { stroke: var(--nb-accent); stroke-width: 2.5; opacity: 1; }
@media (prefers-reduced-motion: reduce) { .nb-diagram * { transition: none !important; } }
@media print {
  .nb-bar, .nb-said { display: none; }
  .nb-diagram, .nb-scroll { overflow: visible; max-height: none; border: 0; }
  .nb-diagram * { -webkit-print-color-adjust: exact; print-color-adjust: exact; }
  .nb-sheet { zoom: var(--nb-print-zoom); }
  .nb-box, .nb-section, .nb-equation { break-inside: avoid; }
}
`;
