"""identify and health need no more memory for a longer drive."""
import conftest


def test_memory_does_not_grow_with_the_drive(program, tmp_path):
    peaks = {}
    for minutes in (2, 40):
        bag = tmp_path / f"{minutes}.bag"
        program.succeed("simulate", "--scenario", "iso_road", "--rate", "200", "--duration", 60 * minutes, "-o", bag)
        peaks[minutes] = [program.peak_kilobytes("identify", bag),
                          program.peak_kilobytes("health", bag, "--csv", tmp_path / "levels.csv"),
                         program.peak_kilobytes("identify", bag, "--config", conftest.PAPER_SETTINGS, "--set",
                                                 "sample_period=0.005", "--csv", tmp_path / "rows.csv")]
    assert bag.stat().st_size > 50e6
    assert (tmp_path / "rows.csv").stat().st_size > 50e6  # the run did come to its end
    for few, many in zip(peaks[2], peaks[40]):
        assert many - few < 2000, peaks
        assert many < 50_000
