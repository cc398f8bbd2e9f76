#include <turnscan/workflow/page/page_style.hpp>

namespace turnscan::page {

std::string_view style() {
  return R"css(
:root { color-scheme: light; --ink: #1d2430; --soft: #5a6472; --line: #d5d8dc; --ground: #f4f5f6; }
* { box-sizing: border-box; }
body { margin: 0; font: 16px/1.5 system-ui, "Segoe UI", Roboto, "DejaVu Sans", sans-serif;
  color: var(--ink); background: #fff; }
main, header, footer { max-width: 75rem; margin: 0 auto; padding: 0 1.25rem; }
header { padding-top: 1.5rem; }
h1 { font-size: 1.7rem; line-height: 1.25; margin: 0; overflow-wrap: anywhere; }
h2 { font-size: 1.25rem; margin: 2.2rem 0 0.7rem; }
h3 { font-size: 1.05rem; margin: 1.2rem 0 0.4rem; overflow-wrap: anywhere; }
p { margin: 0.4rem 0; overflow-wrap: anywhere; }
.soft, figcaption + p, .plot p { color: var(--soft); font-size: 0.92rem; }
a.skip { position: absolute; left: -100rem; }
a.skip:focus { left: 1rem; top: 0.5rem; background: #fff; padding: 0.3rem 0.6rem; z-index: 1; }
:focus-visible { outline: 3px solid #1f5fa8; outline-offset: 2px; }
.table { overflow-x: auto; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; }
th, td { text-align: left; vertical-align: top; padding: 0.3rem 1rem 0.3rem 0;
  border-bottom: 1px solid var(--line); overflow-wrap: break-word; }
th { font-weight: 600; }
td.number, th.number { text-align: right; white-space: nowrap; }
.badge { display: inline-block; padding: 0.25rem 0.9rem; border-radius: 1rem; font-weight: 700; }
.badge.green { background: #1b6e3a; color: #fff; }
.badge.amber { background: #f2b632; color: #1d2430; }
.badge.red { background: #b3261e; color: #fff; }
.level.good::before { content: "\2713\00a0"; color: #1b6e3a; font-weight: 700; }
.level.fair::before { content: "\25B2\00a0"; color: #9a6700; }
.level.bad::before { content: "\2717\00a0"; color: #b3261e; font-weight: 700; }
#view { border: 1px solid var(--line); border-radius: 0.5rem; padding: 0.75rem; }
canvas { display: block; width: 100%; height: min(62vh, 40rem); background: var(--ground);
  border-radius: 0.3rem; }
#switches { display: flex; flex-wrap: wrap; gap: 0.4rem 1.2rem; margin-bottom: 0.6rem; }
fieldset { border: 0; margin: 0; padding: 0; min-width: 0; display: flex; flex-wrap: wrap;
  gap: 0.2rem 0.9rem; align-items: center; }
fieldset legend { float: left; padding: 0 0.6rem 0 0; font-weight: 600; }
label { white-space: nowrap; }
button { font: inherit; color: inherit; background: #fff; border: 1px solid #9aa2ad;
  border-radius: 0.3rem; padding: 0.1rem 0.6rem; margin: 0 0.3rem 0.3rem 0; min-height: 2rem; }
button:hover { background: var(--ground); }
#legend { display: flex; flex-wrap: wrap; gap: 0.3rem 0.6rem; align-items: center;
  margin: 0.6rem 0 0.2rem; font-size: 0.92rem; }
#legend[hidden] { display: none; }
.legend-text { flex-basis: 100%; color: var(--soft); }
.bar { flex: 1 1 8rem; max-width: 22rem; height: 0.9rem; border: 1px solid var(--line); }
.patch { display: inline-block; width: 1rem; height: 1rem; border: 1px solid var(--line);
  vertical-align: -0.15rem; margin-right: 0.3rem; }
.pictures { display: grid; grid-template-columns: repeat(auto-fill, minmax(10.5rem, 1fr));
  gap: 0.75rem; }
figure { margin: 0; }
.pictures img { width: 100%; height: auto; display: block; border: 1px solid var(--line);
  border-radius: 0.3rem; }
.pictures figcaption { text-align: center; font-size: 0.92rem; }
.plots { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(100%, 26rem), 1fr));
  gap: 1.5rem; }
.plot figcaption { font-weight: 600; }
.plot > svg { width: 100%; height: auto; }
.plot svg text { font: 13px system-ui, "Segoe UI", Roboto, "DejaVu Sans", sans-serif; fill: #3b4452; }
.key { list-style: none; display: flex; flex-wrap: wrap; gap: 0 1.2rem; margin: 0.2rem 0; padding: 0;
  font-size: 0.92rem; }
.key svg { width: 34px; height: 8px; vertical-align: middle; }
details { margin: 0.5rem 0; }
summary { cursor: pointer; color: #1f5fa8; }
pre { white-space: pre-wrap; overflow-wrap: anywhere; font-size: 0.8rem; }
footer { margin-top: 2.5rem; padding-bottom: 2rem; border-top: 1px solid var(--line);
  padding-top: 0.8rem; }
@media (max-width: 30rem) {
  main, header, footer { padding-left: 0.9rem; padding-right: 0.9rem; }
  canvas { height: 22rem; }
  th, td { padding-right: 0.7rem; min-width: 5rem; }
  .verdict thead { position: absolute; left: -100rem; }
  .verdict tr { display: grid; grid-template-columns: 1fr auto auto; padding: 0.3rem 0;
    border-bottom: 1px solid var(--line); }
  .verdict th, .verdict td { border: 0; padding: 0.1rem 0.7rem 0.1rem 0; }
  .verdict td:nth-child(3) { grid-column: 1 / -1; grid-row: 2; }
  .stacked thead { position: absolute; left: -100rem; }
  .stacked table, .stacked tbody, .stacked tr, .stacked th, .stacked td { display: block; }
  .stacked th, .stacked td { padding-right: 0; }
  .stacked td { display: flex; justify-content: space-between; gap: 1rem; }
  .stacked td::before { content: attr(data-name); color: var(--soft); }
  .plot svg text { font-size: 18px; }
  .pictures { grid-template-columns: repeat(2, 1fr); }
}
@media print {
  @page { margin: 14mm; }
  body { font-size: 10.5pt; }
  main, header, footer { max-width: none; padding-left: 0; padding-right: 0; }
  #switches, #view-help, details, a.skip { display: none; }
  #view { border: 0; padding: 0; }
  canvas { height: 95mm; }
  .pictures { grid-template-columns: repeat(6, 1fr); gap: 3mm; }
  .plots { grid-template-columns: repeat(2, 1fr); }
  figure, tr, #view { break-inside: avoid; }
  h2, h3 { break-after: avoid; }
  .badge, .bar, .patch, canvas { print-color-adjust: exact; -webkit-print-color-adjust: exact; }
}
)css";
}

}  // namespace turnscan::page
