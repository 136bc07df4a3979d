// How the page looks: on a phone and on a desk, by day and by night.
#pragma once

namespace cost {

constexpr const char* kPageStyle = R"css(
:root { color-scheme: light dark; --ink: #1d2129; --soft: #5c6470; --paper: #fbfaf7; --card: #fff; --rule: #dfdcd4; --own: #c2410c; --lever: #1d5fa8;
  --combination: #7a3fb0; --front: #1b8553; --change: #1b8553; --keep: #1d5fa8; --choose: #a15c07; --warn: #b42318; }
@media (prefers-color-scheme: dark) {
  :root { --ink: #e8e6e1; --soft: #a4a9b3; --paper: #14161a; --card: #1c1f25; --rule: #343842; --own: #fb923c; --lever: #6cb1f7;
    --combination: #c698f5; --front: #4ecb8d; --change: #4ecb8d; --keep: #6cb1f7; --choose: #f2b04a; --warn: #ff8a7d; }
}
* { box-sizing: border-box; }
body { margin: 0; background: var(--paper); color: var(--ink); font: 16px/1.5 system-ui, sans-serif; overflow-wrap: break-word; }
main { max-width: 62rem; margin: 0 auto; padding: 1rem; }
h1 { font-size: 1.6rem; line-height: 1.2; margin: .5rem 0 .2rem; }
h2 { font-size: 1.15rem; margin: 2.2rem 0 .6rem; }
p { margin: .5rem 0; }
.soft, figcaption, footer { color: var(--soft); font-size: .88rem; }
img { display: block; width: 100%; height: auto; border-radius: 4px; background: #000; }
.hero { display: grid; grid-template-columns: 1fr 1fr; gap: .8rem; margin: 1rem 0; }
figure { margin: 0; }
figcaption { margin-top: .25rem; }
.answers { margin: 1rem 0; padding: .3rem .9rem; background: var(--card); border: 1px solid var(--rule); border-radius: 6px; }
.answers dt { font-weight: 600; color: var(--soft); font-size: .88rem; margin-top: .5rem; } .answers dd { margin: 0 0 .5rem; font-size: 1.08rem; line-height: 1.4; }
@media (min-width: 46rem) { .answers { display: grid; grid-template-columns: 9rem 1fr; gap: 0 1rem; align-items: baseline; } .answers dd { margin: .5rem 0; } }
.answers dd:first-of-type { font-weight: 600; }
.findings { margin: 1rem 0; padding: 0; list-style: none; display: grid; gap: .6rem; }
.findings li { border-left: 4px solid var(--rule); padding: .1rem .8rem; }
.findings .switch, .findings .upgrade { border-left-color: var(--change); } .findings .keep { border-left-color: var(--keep); } .findings .choose { border-left-color: var(--choose); }
.findings .switch b, .findings .upgrade b { color: var(--change); } .findings .keep b { color: var(--keep); } .findings .choose b { color: var(--choose); }
.warning { color: var(--warn); }
.howto { padding: .3rem .9rem; margin: 1rem 0; }
pre { margin: .3rem 0; padding: .5rem .7rem; border: 1px solid var(--rule); border-radius: 4px; background: var(--paper); font-size: .85rem; white-space: pre-wrap; overflow-wrap: anywhere; }
pre span { display: block; padding-left: 1.5em; text-indent: -1.5em; }
.chip { display: inline-block; padding: 0 .6em; border: 1px solid currentColor; border-radius: 1em; font-size: .8rem; white-space: nowrap; color: var(--soft); }
.chip.switch, .chip.upgrade, .chip.could-switch { color: var(--change); } .chip.keep { color: var(--keep); } .chip.choose { color: var(--choose); }
.chip.switch, .chip.upgrade { background: var(--change); border-color: var(--change); color: var(--card); font-weight: 600; }
.badge { color: var(--ink); font-size: .8rem; font-weight: 600; white-space: nowrap; }
.settings { background: var(--card); border: 1px solid var(--rule); border-radius: 6px; }
td small, .settings small { display: block; color: var(--soft); font-size: .78rem; line-height: 1.3; }
.settings tbody > tr:first-child > * { border-top: 1px solid var(--rule); } .settings th, .settings td { border-bottom: 0; vertical-align: baseline; }
.settings tbody th, .settings .tried, .settings .do { text-align: left; white-space: normal; } .settings tbody th { font-weight: 600; }
.settings thead th:nth-child(2), .settings thead th:last-child { text-align: left; }
.settings .choices th, .settings small { font-weight: 400; } .settings .do { min-width: 12.5rem; padding-left: 1.2rem; } .settings thead th { max-width: 7rem; }
@media (max-width: 46rem) {
  .settings, .settings tbody, .settings tr, .settings th, .settings td { display: block; text-align: left; white-space: normal; }
  .settings { border: 0; background: none; } .settings thead { display: none; }
  .settings tbody { background: var(--card); border: 1px solid var(--rule); border-radius: 6px; margin: 0 0 .7rem; padding: .3rem .2rem; }
  .settings tbody > tr:first-child > * { border-top: 0; } .settings tr + tr { border-top: 1px dashed var(--rule); margin-top: .3rem; padding-top: .3rem; }
  .settings th, .settings td { padding: .15rem .6rem; } .settings td:empty { display: none; }
  .settings td[data-label]::before { content: attr(data-label) ": "; color: var(--soft); }
  .settings td[data-label] { display: inline-block; padding-right: .4rem; } .settings td small { display: inline; margin-left: .5em; }
  .settings .tried::before { content: "instead: "; color: var(--soft); } .settings .do { padding-left: .6rem; }
}
.left-out { padding-left: 1.1rem; } .left-out li { margin: .15rem 0; }
.card { background: var(--card); border: 1px solid var(--rule); border-radius: 6px; padding: .5rem; }
.plot { width: 100%; height: auto; font-family: inherit; }
.plot text { fill: var(--ink); font-size: 11px; } .plot .tick { fill: var(--soft); font-size: 10px; } .plot .axis { fill: var(--soft); }
.plot .grid { stroke: var(--rule); stroke-width: .7; } .plot .leader { stroke: var(--soft); stroke-width: .5; }
.plot .halfway { stroke: var(--soft); stroke-dasharray: 1 3; } .plot .important { font-weight: 700; }
.pale { opacity: .5; }
.plot .front { fill: none; stroke: var(--front); stroke-width: 1.6; } .plot .floor { stroke: var(--soft); stroke-dasharray: 4 3; }
.plot .spread { fill: none; stroke: currentColor; stroke-width: 1.6; opacity: .55; }
.own { color: var(--own); } .lever { color: var(--lever); } .combination { color: var(--combination); } .half { color: var(--ink); }
.solid { fill: currentColor; } .plot .solid { stroke: var(--card); stroke-width: 1; } .hollow { fill: none; stroke: currentColor; stroke-width: 1.6; }
.front-line path { stroke: var(--front); stroke-width: 2; }
.plot text.label { paint-order: stroke; stroke: var(--card); stroke-width: 3px; stroke-linejoin: round; }
.wide { display: none; }
@media (min-width: 46rem) { .wide { display: block; } .narrow { display: none; } }
.legend { display: flex; flex-wrap: wrap; gap: .2rem 1.1rem; margin: .3rem .2rem; padding: 0; list-style: none; font-size: .88rem; }
.legend svg { width: 14px; height: 14px; vertical-align: -2px; margin-right: .3em; overflow: visible; }
.numbers { columns: 20rem; margin: .2rem; padding: 0; list-style: none; font-size: .88rem; }
.numbers li { break-inside: avoid; }
.scroll { overflow-x: auto; border: 1px solid var(--rule); border-radius: 6px; background: var(--card); }
table { border-collapse: separate; border-spacing: 0; font-size: .86rem; width: 100%; font-variant-numeric: tabular-nums; }
th, td { padding: .35rem .5rem; text-align: right; border-bottom: 1px solid var(--rule); }
td { white-space: nowrap; } tbody tr:last-child > * { border-bottom: 0; }
thead th { color: var(--soft); font-weight: 600; vertical-align: bottom; } .figures { font-size: .8rem; } .figures th, .figures td { padding: .35rem .3rem; }
.settings th:first-child { text-align: left; }
.figures th:first-child { position: sticky; left: 0; background: var(--card); border-right: 1px solid var(--rule); min-width: 8.6rem; text-align: left; font-weight: 400; }
@media (min-width: 46rem) { .figures th:first-child { min-width: 11rem; } }
summary { cursor: pointer; padding: .2rem; }
.cases > * { margin: 0; padding: .35rem .4rem; } .cases > * + * { border-top: 1px solid var(--rule); }
.cases > p { padding-left: 1.5rem; } .cases .held { display: inline-block; min-width: 2.2em; }
.cases ul { margin: .2rem 0; padding-left: 2.2rem; font-size: .88rem; color: var(--soft); }
.pair { display: grid; grid-template-columns: 1fr 1fr; gap: .4rem; margin: .4rem 0 1.2rem; }
.pair p { grid-column: 1 / -1; margin: 0; }
.pictures { margin-top: 1.2rem; display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 26rem), 1fr)); gap: 0 1.4rem; }
.key { max-width: 30rem; } .scale { height: 12px; image-rendering: pixelated; } .steps { display: flex; justify-content: space-between; }
code { background: var(--card); border: 1px solid var(--rule); border-radius: 4px; padding: .1em .35em; font-size: .85em; }
a { color: var(--lever); } .term { color: inherit; text-decoration: underline dotted; text-underline-offset: .2em; }
.words { font-size: .92rem; } .words code { white-space: nowrap; } .words dt { font-weight: 600; } .words dd { margin: 0 0 .5rem 0; } .words :target { color: var(--own); }
@media (min-width: 46rem) { .words { display: grid; grid-template-columns: 11rem 1fr; } .words dd { margin-bottom: .3rem; } }
footer { border-top: 1px solid var(--rule); margin-top: 2rem; padding-top: .6rem; }
)css";

}  // namespace cost
