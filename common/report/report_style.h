// How the page of a report looks; private to report/report.cpp.
#pragma once

namespace whine {

inline constexpr const char* kStyle = R"(
:root { color-scheme: light dark; --ink: #1c2127; --soft: #59626d; --paper: #ffffff; --line: #d5dae0; --band: #f3f5f7; --mark: #b42318; --link: #1f4e9c; }
@media (prefers-color-scheme: dark) { :root { --ink: #e4e7eb; --soft: #a3adb8; --paper: #14181d; --line: #39424d; --band: #1d232a; --mark: #ff8a7a; --link: #8ab4f8; } }
* { box-sizing: border-box; }
body { margin: 0; background: var(--paper); color: var(--ink); font: 16px/1.5 "DejaVu Sans", "Segoe UI", Roboto, Helvetica, Arial, sans-serif; }
main, header, footer { max-width: 66rem; margin: 0 auto; padding: 0 1.25rem; }
header { padding-top: 2rem; border-bottom: 2px solid var(--ink); }
h1 { font-size: 1.6rem; line-height: 1.25; margin: 0 0 .3rem; }
h2 { font-size: 1.25rem; margin: 2.6rem 0 .8rem; border-bottom: 1px solid var(--line); padding-bottom: .2rem; }
h3 { font-size: 1rem; margin: 1.4rem 0 .2rem; }
.opening { padding-left: 1.4rem; max-width: 60rem; } .opening li { margin: .35rem 0; }
table.results { margin-top: .2rem; } table.results td:first-child { max-width: 30rem; }
.scene { color: var(--soft); margin: 0 0 1rem; }
nav ol { columns: 2; padding-left: 1.4rem; margin: 1rem 0; }
a { color: var(--link); }
figure { margin: 1.4rem 0 2rem; }
figure img { display: block; width: 100%; height: auto; background: #ffffff; border: 1px solid var(--line); }
figcaption { font-size: .92rem; margin-top: .5rem; max-width: 60rem; }
.files { color: var(--soft); white-space: nowrap; font-size: .85rem; margin-left: .4rem; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; margin: 1rem 0 1.6rem; font-size: .9rem; font-variant-numeric: tabular-nums; }
caption { text-align: left; font-size: .92rem; padding-bottom: .4rem; }
th { text-align: left; border-bottom: 1.5px solid var(--ink); }
th, td { padding: .22rem .8rem .22rem 0; vertical-align: top; }
td { border-bottom: 1px solid var(--line); }
.number { text-align: right; min-width: 5.5rem; }
th { vertical-align: bottom; }
td:first-child { overflow-wrap: anywhere; min-width: 6rem; }
td:nth-child(2) { white-space: nowrap; }
table.small, table.broad { font-size: .8rem; }
table.broad .number { min-width: 0; }
table.broad th, table.broad td { padding-right: .55rem; }
table.code td { font-family: "DejaVu Sans Mono", Consolas, monospace; font-size: .7rem; overflow-wrap: anywhere; min-width: 8rem; white-space: normal; text-align: left; }
.guide td { min-width: 11rem; white-space: normal; }
.remarks { padding-left: 1.2rem; }
.warning strong { color: var(--mark); }
footer { color: var(--soft); font-size: .85rem; padding-bottom: 3rem; }
@media print {
  :root { --ink: #000000; --soft: #444444; --paper: #ffffff; --line: #bbbbbb; --mark: #b42318; --link: #000000; }
  body { font-size: 10pt; } main, header, footer { max-width: none; padding: 0; }
  figure, tr { break-inside: avoid; } h2, h3 { break-after: avoid; } .files { display: none; } .wide { overflow: visible; }
  table, table.small, table.broad { font-size: 7.5pt; } table.broad { font-size: 6.5pt; } th, td { padding-right: .4rem; }
  .number, td:first-child { min-width: 0; } td:nth-child(2) { white-space: normal; } table.code td { font-size: 5.5pt; min-width: 4rem; }
}
)";

}  // namespace whine
