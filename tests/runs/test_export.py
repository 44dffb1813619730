"""[Output] Contact problems: what is written is the variational inequality that
was solved, in both formats."""

import numpy

from crevasse_run import SOURCE, check, check_below, run


def matrix_market(path):
    """A dense array or matrix; the files of this test are small."""
    with open(path) as file:
        header = file.readline().split()
        line = file.readline()
        while line.startswith("%"):
            line = file.readline()
        sizes = [int(word) for word in line.split()]
        values = numpy.array([[float(word) for word in row.split()]
                              for row in file if row.strip()])
    if header[2] == "array":
        return values.reshape(sizes[::-1]).T
    dense = numpy.zeros(sizes[:2])
    check(len(values) == sizes[2], f"{path}: entries")
    for row, column, value in values:
        dense[int(row) - 1, int(column) - 1] += value
    return dense


def petsc_objects(path):
    """The objects of a PETSc binary file: big-endian, 32-bit integers."""
    data = path.read_bytes()
    place = 0

    def take(kind, count):
        nonlocal place
        values = numpy.frombuffer(data, kind, count, place)
        place += values.nbytes
        return values

    while place < len(data):
        kind = take(">i4", 1)[0]
        if kind == 1211216:  # a matrix by rows
            n_rows, n_columns, n_entries = take(">i4", 3)
            lengths = take(">i4", n_rows)
            columns, values = take(">i4", n_entries), take(">f8", n_entries)
            dense = numpy.zeros((n_rows, n_columns))
            rows = numpy.repeat(numpy.arange(n_rows), lengths)
            dense[rows, columns] = values
            yield dense
        else:
            check(kind == 1211214, f"{path}: no vector")
            yield take(">f8", take(">i4", 1)[0]).astype(float)


def test_problem(results, period, step, is_closed):
    name = f"contact_problem_{period}_{step}"
    print(name)
    parts = {part: matrix_market(results.directory / f"{name}_{part}.mtx")
             for part in ("matrix", "right_hand_side", "lip", "solution")}
    A, b, q = (parts["matrix"], parts["right_hand_side"][:, 0],
               parts["solution"][:, 0])
    check_below(abs(A - A.T).max() / abs(A).max(), 1e-15, "symmetry")
    dofs, sign, gap = parts["lip"].T
    dofs = dofs.astype(int)
    check(len(dofs) == results.summary["contact_nodes"], "bounds")

    residual = A @ q - b
    force = sign * residual[dofs]
    opening = sign * q[dofs] - gap
    residual[dofs] = 0
    size = abs(b).max()
    check_below(abs(residual).max() / size, 1e-10, "residual")
    check_below(-force.min() / size, 1e-10, "tension")
    check_below(-opening.min() / abs(q).max(), 1e-14, "penetration")
    check(all(force > 0.01 * size) if is_closed else
          all(opening > 0.01 * abs(q).max()), "open or closed as expected")

    matrix, *vectors = petsc_objects(results.directory / f"{name}.petsc")
    lower, upper = numpy.full(len(b), -1e300), numpy.full(len(b), 1e300)
    lower[dofs[sign > 0]] = gap[sign > 0]
    upper[dofs[sign < 0]] = -gap[sign < 0]
    check_below(abs(matrix - A).max() / abs(A).max(), 1e-14, "PETSc's matrix")
    for vector, expected in zip(vectors, (b, lower, upper, q), strict=True):
        check(numpy.allclose(vector.clip(-1e300, 1e300), expected, 1e-14, 0),
              "PETSc's vectors")


results = run(SOURCE / "prm/raous1980.prm", "export",
              ["Contact/Solver=automatic", "Output/Fields=none",
               "Periodic state/Maximum periods=9",
               "Output/Contact problems=1: 10; 1: 34; 9: 0"])
test_problem(results, 1, 10, False)
test_problem(results, 1, 34, True)
log = (results.directory / "log.txt").read_text()
check("did not come to period 9, step 0" in log, log)
