"""The record as a table: a head for each column, whatever a bearing tells."""

import numpy as np

from orchestrator.results.record_files import TABLE_FILE, write_record
from tests.orchestrator.results import synthetic_record


def test_every_column_has_a_head_of_its_own(tmp_path):
    record = synthetic_record.record(end=0.02, fracture=None).isel(bearing=[0, 1])
    tilts = np.arange(21 * 2 * 3).reshape(21, 2, 3) * 1e-6
    record["pad_tilt"] = (("time", "bearing", "pad"), tilts, {"units": "rad"})
    write_record(record, tmp_path)
    heads, *rows = (tmp_path / TABLE_FILE).read_text().splitlines()
    heads, table = heads.split(","), np.array([row.split(",") for row in rows], dtype=float)
    assert table.shape == (21, len(heads)) and len(set(heads)) == len(heads)
    tilt = table[:, heads.index("HP-rear.pad_tilt_3 [rad]")]
    np.testing.assert_allclose(tilt, tilts[:, 1, 2], rtol=1e-9)
    force = record["force"].sel(bearing="HP-front", axis="y").values
    np.testing.assert_allclose(table[:, heads.index("HP-front.force_y [N]")], force, rtol=1e-9)
