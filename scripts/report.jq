# What the sections of docs/accuracy.md share: figures, names and tables.

def rounded(digits): . * pow(10; digits) | round / pow(10; digits);
def significant($digits): if . == 0 then 0 else ($digits - 1 - (fabs | log10 | floor)) as $decimals | rounded($decimals) end;
# As minirt-cost writes them: to two digits at most, near the whole by what is missing; 0 % is 0 alone.
def percent: . * 100 | fabs as $size
    | if $size > 0 and $size < 0.01 then "under 0.01 %"
      elif $size > 99.99 and $size < 100 then "over 99.99 %"
      elif $size > 99 and $size < 100 then "\(significant(if $size > 99.9 then 4 else 3 end)) %"
      elif $size < 9.95 then "\(significant(2)) %" else "\(round) %" end;
# "llvmpipe (LLVM 15.0.6, 256 bits)" is lavapipe to people.
def short_name: if test("llvmpipe") then "lavapipe" else sub(" *\\(.*"; "") | sub("^NVIDIA "; "") end;
def row: "| " + join(" | ") + " |";
def table(head): (head | row), (head | map("---") | row), .[];
# In the order of the first appearance.
def distinct: reduce .[] as $x ([]; if index([$x]) then . else . + [$x] end);
# Of a file: seed_whisky of build/accuracy/seed_whisky.json.
def scene_of: sub(".*/"; "") | sub("\\.json$"; "");
