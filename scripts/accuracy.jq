# docs/accuracy.md out of the JSON files of minirt-cost, of any number of devices; scripts/accuracy runs it. A device is a folder of files.

include "report";

def spread: "\(.median | rounded(2)) (\(.lower_quartile | rounded(2))–\(.upper_quartile | rounded(2)))";

def lever_names: ["samples", "integrator", "depth", "cutoff", "light_sampling", "intersection", "ray_offset", "fresnel", "normals", "nesting",
    "absorption", "dispersion", "precision", "weak_rays"];

def introduction($devices):
"# What accuracy costs in time

Written by `scripts/accuracy` from measurements of `minirt-cost`; run it again on your device. " +
([$devices[] | "\(.name): \(.device), \(.driver), \(.date)."] | join(" ")) + (if $note == "" then "" else " " + $note end) + "

Each lever is moved alone from what the scene says by itself. **Error** is relMSE, the mean of (x − r)² / (r² + 0.01) without the worst
0.1 % of the pixels, against a reference with every lever at its most accurate; as expected at the scene's own samples, where bias has
stayed and noise has fallen. Samples are named at that number too, also where fewer were measured. **Time** is the accurate setting's over the cheap one's: the median, and the middle half, of all pairs of repeats, which were
measured in rounds in which all settings take turns; the drift of whole rounds is taken out. A pixel is **wrong** when its 8-bit sRGB value is off by more
than 2 steps; given where pictures have no noise, by how many more the cheap setting gets wrong at the same samples.
`keep`: costs no time, or the error falls by a larger factor than the time grows; `trade`: more accurate, but the time grows by the larger factor; `spare`: costs time for
nothing; `either`: no difference; `·`: it can change nothing there." + (if $effects == "0" then "" else "

What it gains that kernels hold only the effects of their scene is [at the end](#only-the-effects-that-a-scene-calls-for)." end);

# The leading verdicts of each scene.
def glance:
    map(. as $m | ["`\(.scene)`", .name] + (lever_names | map(. as $lever |
        first($m.report.comparisons[] | select(.lever == $lever and .leading) | .verdict) // "·")) | row)
    | table(["scene", "device"] + (lever_names | map(gsub("_"; " "))));

# One comparison in words: "exact over none".
def moved: "\(.accurate) over \(.cheap)";
def lost: if .change == "none" then "none seen" else .error_removed | percent end;

# All comparisons of a lever with where they were made.
def comparisons($lever): map(. as $m | .report.comparisons[] | select(.lever == $lever) | . + {scene: $m.scene, name: $m.name});

# A row a scene and setting, with the columns of each device.
def lever_rows($lever; $names):
    comparisons($lever) | group_by([.scene, moved]) | map(. as $group |
        ["`\($group[0].scene)`", ($group[0] | moved)] + ($names | map(. as $name |
            first($group[] | select(.name == $name) | [(.slowdown | spread), lost, (.wrong_pixels_of_cheap | percent), .verdict])
            // ["·", "·", "·", "·"]) | add) | row);
def lever_section($names):
    . as $all | lever_names | map(. as $lever | ($all | lever_rows($lever; $names)) | select(length > 0)
        | "\n### \($lever)\n", table(["scene", "setting"] + ($names | map((if ($names | length) > 1 then ", " + . else "" end) as $of
            | ["time" + $of, "error removed", "pixels wrong without", ""]) | add))) | .[];

# Where a lever matters the most: the scene in which its accurate setting removes the largest part of the error.
def where_it_matters($lever):
    comparisons($lever) | map(select(.change == "less error")) | sort_by(.error_removed) | last
    | if . == null then "·" else "`\(.scene)`, \(moved) (\(.name)): \(.error_removed | percent) of the error"
        + (if .wrong_pixels_of_cheap > 0.002 then ", \(.wrong_pixels_of_cheap | percent) of the pixels" else "" end)
        + ", \(.slowdown.median | rounded(2)) times the time" end;
# And where not: a scene in which none of its settings shows, the one that pays the most for it; else one in which it can change nothing.
def where_it_does_not($lever):
    . as $all | ([comparisons($lever) | group_by([.scene, .name])[] | select(all(.change == "none")) | max_by(.slowdown.median)]
        | sort_by(.slowdown.median) | last) as $measured
    | (first($all[] | . as $m | .report.levers[] | select(.name == $lever and (.applies | not)) | {scene: $m.scene, reason}) // null) as $idle
    | (if $measured == null then null else $measured | "`\(.scene)`, \(moved) (\(.name)): nothing that could be measured, \(.slowdown.median | rounded(2)) times the time" end) as $m
    | (if $idle == null then null else $idle | "`\(.scene)`: \(.reason)" end) as $i | [$m, $i] | map(select(. != null)) | if . == [] then "·" else join("; ") end;
def where_levers_matter:
    . as $all | lever_names | map(. as $lever | ["`\($lever)`", ($all | where_it_matters($lever)), ($all | where_it_does_not($lever))] | row)
    | table(["lever", "matters the most in", "loses nothing in"]);

def scene_section:
    .report as $r | "\n### `\(.scene)`, \(.name)\n\n\($r.width) × \($r.height), \($r.samples) of \($r.scene_samples) samples a pixel; its own settings take \($r.measurements[0].ms.median | rounded(2)) ms with relMSE \($r.measurements[0].error.relmse | significant(3)); the reference has \($r.reference.samples) samples and relMSE \($r.reference.relmse | significant(2)) of its own.\n",
    ($r.findings[] | "- " + .), ($r.levers[] | select(.applies | not) | "- \(.name) is left alone: \(.reason).");

[inputs | {scene: (input_filename | scene_of), name: (.device | short_name), report: .}]
| ([.[].name] | distinct) as $names
| . as $all
| introduction($names | map(. as $name | first($all[] | select(.name == $name)) | {name, device: .report.device, driver: .report.driver, date: .report.date})),
  "\n## Where a lever matters, and where it does not\n\nOf all scenes and devices below: where the accurate setting removes the largest part of the error, and where the cheap one loses nothing.\n", where_levers_matter,
  "\n## At a glance\n", glance,
  "\n## Lever by lever", lever_section($names),
  "\n## Scene by scene", (.[] | scene_section)
