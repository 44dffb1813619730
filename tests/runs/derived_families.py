"""Families of runs whose derived numbers are known in two ways: K_op, closed parts,
Delta K, da/dN, pressures, C(t). Each function draws one instance and states its bounds.

Steps bound what samples tell of a load factor F. Its maximum lies at most h^2/8 |F''|
above the largest sample; h^2 |F''| is Wave.bend()."""

from derived_bodies import blocked_corner, kinked_lips, penny, wide_ring
from derived_modes import mirrored_modes, reversed_modes, units
from derived_phases import half_and_full, phase_creeping, phase_elastic
from derived_runs import pulse, resumed, schemes, shifted_jumps, written

FAMILIES = {"phase, elastic": phase_elastic, "phase, creeping": phase_creeping,
            "half and full": half_and_full, "penny": penny, "wide ring": wide_ring,
            "mirrored, turned": mirrored_modes, "reversed modes": reversed_modes,
            "units": units, "kinked lips": kinked_lips, "rigid corner": blocked_corner,
            "resumed": resumed, "creep schemes": schemes, "pulse": pulse,
            "viscosity, written": written, "jumps, shifted": shifted_jumps}
