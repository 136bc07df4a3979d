# The section of docs/accuracy.md on what pruned kernels gain, out of the JSON files of minirt-bench --effects; scripts/accuracy runs it.

include "report";

def kilobytes: . / 1000 | round;
def pair(get): "\(.pruned | get) of \(.all_effects | get)";
def between: "\(.median | rounded(2)) (\(.lower | rounded(2))–\(.upper | rounded(2)))";
def told: .pruned.registers != null;

def device_table: (any(.[]; .report | told)) as $told
    | map(.scene as $scene | .report | ["`\($scene)` \(.integrator)", pair(.spirv_bytes | kilobytes), pair(.first_dispatch_ms | round),
        pair(.ms_per_sample.median | significant(3)), (.speedup | between)]
        + (if $told then [pair(.registers // "·"), pair(.stack_bytes // "·")] else [] end) | row)
    | table(["scene, integrator", "SPIR-V, kB", "first dispatch, ms", "ms a sample", "times faster"]
        + (if $told then ["registers", "stack, bytes"] else [] end));

def device_section: .[0] as $first
    | "\n\($first.name), \($first.report.width) × \($first.report.height), medians of \($first.rounds):\n", device_table;

[inputs | {scene: (input_filename | scene_of), name: (.device | short_name), rounds, report: .effects[]}]
| if length == 0 then empty else
    "\n## Only the effects that a scene calls for\n\nKernels as `minirtc` bakes them, beside kernels with every effect (`--all-effects`) that draw the same pictures by turns, a process a scene (`minirt-bench --effects`): what the scene calls for *of* what all effects take. The first dispatch is with nothing cached, creation of the pipelines included; how many times faster: the median and the middle half of the rounds. Registers and stack are given where the driver tells (VK_KHR_pipeline_executable_properties).",
    (. as $all | [.[].name] | distinct[] | . as $name | [$all[] | select(.name == $name)] | device_section)
  end
