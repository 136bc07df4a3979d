"""What bench/cycles found: cycles_report.py FOLDER REFERENCE ROUNDS SAMPLES... prints a table and writes FOLDER/cycles.json."""
import array
import json
import os
import statistics
import sys

RENDERERS = ("trees", "paths", "cycles")  # the first two are minirt's
CLOCKS = ("seconds", "processor_seconds")
EPSILON = 0.01  # keeps relMSE finite where the reference is black
OUTLIERS = 0.001  # share of the values, the largest, without which relMSE is given too: a single spark can decide it


def read_pfm(path):
    with open(path, "rb") as file:
        assert file.readline() == b"PF\n", path
        file.readline()
        assert float(file.readline()) < 0, path
        values = array.array("f")
        values.frombytes(file.read())
    if sys.byteorder == "big":
        values.byteswap()
    return values


def rel_mse(picture, reference):
    """Over all pixels and channels; and without the outliers."""
    errors = sorted((x - r) ** 2 / (r * r + EPSILON) for x, r in zip(picture, reference))
    kept = errors[: len(errors) - int(len(errors) * OUTLIERS)]
    return sum(errors) / len(errors), sum(kept) / len(kept)


def read_times(path):
    """Of lines "samples seconds processor-seconds", of which the last may be several to add: for each clock {samples: seconds}."""
    with open(path, encoding="ascii") as file:
        lines = [line.split() for line in file]
    return {
        "seconds": {int(count): float(seconds) for count, seconds, *_ in lines},
        "processor_seconds": {int(count): sum(map(float, parts)) for count, _, *parts in lines},
    }


def seconds_a_sample(times):
    """The slope of a line through (samples, seconds): what is done once a picture is in its other end."""
    n, x, y = len(times), statistics.mean(times), statistics.mean(times.values())
    if n < 2:
        return y / x
    return sum((a - x) * (b - y) for a, b in times.items()) / sum((a - x) ** 2 for a in times)


def spread(values):
    return {"median": statistics.median(values), "low": min(values), "high": max(values)}


def measure(folder, renderer, reference, rounds, counts):
    truth = read_pfm(os.path.join(folder, f"{renderer}_reference_{reference}.pfm"))
    result = {"error_times_samples": [], "rel_mse": {count: [] for count in counts}, "error_times_samples_of": {count: [] for count in counts}}
    result["seconds"] = {count: [] for count in counts}
    result.update({f"{clock}_a_sample": [] for clock in CLOCKS})
    for round_ in range(1, rounds + 1):
        prefix = os.path.join(folder, f"{renderer}_{round_}")
        times = read_times(prefix + ".times")
        products = []
        for count in counts:
            errors = rel_mse(read_pfm(f"{prefix}_{count}.pfm"), truth)
            result["rel_mse"][count].append(errors)
            result["seconds"][count].append(times["seconds"][count])
            products.append(errors[1] / (1 / count + 1 / reference))  # the reference has noise of its own
            result["error_times_samples_of"][count].append(products[-1])
        for clock in CLOCKS:
            result[f"{clock}_a_sample"].append(seconds_a_sample(times[clock]))
        result["error_times_samples"].append(statistics.mean(products))
    return result


def time_at_equal_noise(one, other, clock, count=None):
    """Over that of another renderer, round by round; by the errors of pictures of `count` samples, or of all."""
    costs = []
    for m in (one, other):
        errors = m["error_times_samples_of"][count] if count else m["error_times_samples"]
        costs.append([e * s for e, s in zip(errors, m[f"{clock}_a_sample"])])
    return spread([a / b for a, b in zip(*costs)])


def times_at_equal_noise(one, other, counts):
    """For each clock of all pictures together, and by elapsed time of each number of samples."""
    times = {clock: time_at_equal_noise(one, other, clock) for clock in CLOCKS}
    times["seconds_by_samples"] = {count: time_at_equal_noise(one, other, "seconds", count) for count in counts}
    return times


def summary(measured):
    def of(count):
        full, kept = zip(*measured["rel_mse"][count])
        return {"samples": count, "seconds": spread(measured["seconds"][count]), "rel_mse": spread(full), "rel_mse_without_outliers": spread(kept)}

    names = ("seconds_a_sample", "processor_seconds_a_sample", "error_times_samples")
    return {**{name: spread(measured[name]) for name in names}, "pictures": [of(count) for count in measured["seconds"]]}


def compare_references(folder, reference, measured):
    """relMSE of each of minirt's against that of Cycles, what of it is noise, and the means."""
    truths = {one: read_pfm(os.path.join(folder, f"{one}_reference_{reference}.pfm")) for one in RENDERERS}
    noise = {one: statistics.median(measured[one]["error_times_samples"]) / reference for one in RENDERERS}

    def of(one):
        full, kept = rel_mse(truths[one], truths["cycles"])
        return {"rel_mse": full, "rel_mse_without_outliers": kept, "expected_of_noise": noise[one] + noise["cycles"]}

    means = {one: sum(truth) / len(truth) for one, truth in truths.items()}
    return {"samples": reference, "means": means, **{one: of(one) for one in RENDERERS[:2]}}


def print_report(report):
    references = report["references"]
    for one in RENDERERS[:2]:
        r = references[one]
        print(f"References of {references['samples']} samples, {one} and cycles: relMSE {r['rel_mse']:.3g}, without outliers {r['rel_mse_without_outliers']:.3g}, "
              f"of which their noise explains {r['expected_of_noise']:.3g}; means {references['means'][one]:.5g} and {references['means']['cycles']:.5g}")
    print(f"{'':8} {'samples':>8} {'seconds':>9} {'relMSE':>10} {'without outliers':>17}")
    for one in RENDERERS:
        for row in report[one]["pictures"]:
            print(f"{one:8} {row['samples']:8} {row['seconds']['median']:9.3f} {row['rel_mse']['median']:10.4g} "
                  f"{row['rel_mse_without_outliers']['median']:17.4g}")
    for one in RENDERERS:
        s = report[one]
        print(f"{one}: {s['seconds_a_sample']['median'] * 1e3:.1f} ms a sample, {s['processor_seconds_a_sample']['median'] * 1e3:.1f} ms of processor time; "
              f"error x samples {s['error_times_samples']['median']:.4g}")
    for one in RENDERERS[:2]:
        wall, processor = (report["time_over_cycles_at_equal_noise"][one][clock] for clock in CLOCKS)
        print(f"Time of {one} at the noise of Cycles: {wall['median']:.2f} of its time ({wall['low']:.2f}-{wall['high']:.2f}), "
              f"{processor['median']:.2f} of its processor time ({processor['low']:.2f}-{processor['high']:.2f})")
        by_samples = report["time_over_cycles_at_equal_noise"][one]["seconds_by_samples"]
        print("  by pictures of " + ", ".join(f"{count} samples: {ratio['median']:.2f}" for count, ratio in by_samples.items()))


def main(folder, reference, rounds, *counts):
    reference, rounds, counts = int(reference), int(rounds), [int(count) for count in counts]
    measured = {one: measure(folder, one, reference, rounds, counts) for one in RENDERERS}
    report = {"references": compare_references(folder, reference, measured)}
    report.update({one: summary(measured[one]) for one in RENDERERS})
    report["time_over_cycles_at_equal_noise"] = {
        one: times_at_equal_noise(measured[one], measured["cycles"], counts) for one in RENDERERS[:2]
    }
    with open(os.path.join(folder, "cycles.json"), "w", encoding="ascii") as file:
        json.dump(report, file, indent=2)
        file.write("\n")
    print_report(report)


main(*sys.argv[1:])
