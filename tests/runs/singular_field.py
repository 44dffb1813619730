"""The singular field of Hutchinson, Rice and Rosengren (J. Mech. Phys. Solids 16,
1968): I_n and the hoop stress ahead of the tip, by shooting.

With the stress function r^s f(phi), s = (2n+1)/(n+1), stresses go with r^(s-2) and
strains with r^m, m = -n/(n+1). Unknowns: f, f', the radial strain e_r, its derivative
less 2(m+1) times the shear strain, and the displacement u_phi."""

import math


class SingularField:
    def __init__(self, n, plane_stress):
        self.n, self.s, self.m = n, (2 * n + 1) / (n + 1), -n / (n + 1)
        self.plane_stress = plane_stress

    def at(self, y):
        """Stresses r, phi, r phi, von Mises' one, and strains r, phi, r phi."""
        f, slope, e_r = y[:3]
        hoop, shear = self.s * (self.s - 1) * f, (1 - self.s) * slope
        # e_r = c x s_e^(n-1) with s_e² = a x² + b
        a, b, c = ((1., 0.75 * hoop ** 2 + 3 * shear ** 2, 1.) if self.plane_stress
                   else (0.75, 3 * shear ** 2, 0.75))
        x = self.solve(e_r / c, a, b)
        radial = x + (hoop / 2 if self.plane_stress else hoop)
        s_e = math.sqrt(a * x * x + b)
        factor = s_e ** (self.n - 1)
        e_hoop = factor * (hoop - radial / 2) if self.plane_stress else -e_r
        return radial, hoop, shear, s_e, e_r, e_hoop, 1.5 * factor * shear

    def solve(self, wanted, a, b):
        """x (a x² + b)^((n-1)/2) = wanted, by Newton's method in ln x."""
        if wanted == 0:
            return 0.
        power, logarithm = (self.n - 1) / 2, math.log(abs(wanted))
        z = (logarithm - power * math.log(a)) / self.n
        if b > 0:
            z = min(z, logarithm - power * math.log(b))
        for _ in range(60):
            part = a * math.exp(2 * z)
            rest = z + power * math.log(part + b) - logarithm
            z -= rest / (1 + 2 * power * part / (part + b))
            if abs(rest) < 1e-13:
                break
        return math.copysign(math.exp(z), wanted)

    def slopes(self, y):
        radial, _, _, _, e_r, e_hoop, e_shear = self.at(y)
        m = self.m
        return (y[1], radial - self.s * y[0], y[3] + 2 * (m + 1) * e_shear,
                m * e_r - m * (m + 1) * e_hoop, e_hoop - e_r / (m + 1))

    def path(self, curvature, steps=300):
        """From f = 1, f'' = curvature ahead of the tip to its lip, by rk4."""
        radial, hoop = self.s + curvature, self.s * (self.s - 1)
        if self.plane_stress:
            s_e = math.sqrt(radial ** 2 + hoop ** 2 - radial * hoop)
            e_r = s_e ** (self.n - 1) * (radial - hoop / 2)
        else:
            s_e = math.sqrt(0.75) * abs(radial - hoop)
            e_r = 0.75 * s_e ** (self.n - 1) * (radial - hoop)
        h, path = math.pi / steps, [[1., 0., e_r, 0., 0.]]
        for _ in range(steps):
            y = path[-1]
            stages = [self.slopes(y)]
            for part in (h / 2, h / 2, h):
                stages.append(self.slopes([a + part * b for a, b in
                                           zip(y, stages[-1])]))
            path.append([v + h / 6 * (a + 2 * b + 2 * c + d)
                         for v, a, b, c, d in zip(y, *stages)])
        return path

    def quantities(self):
        """I_n and the hoop stress ahead, for a largest von Mises' stress of 1."""
        low, high = -1., -0.5  # the lip is free where f' vanishes there; f does too
        for _ in range(40):
            middle = (low + high) / 2
            if self.path(middle)[-1][1] > 0:
                low = middle
            else:
                high = middle
        path, largest, integrand = self.path(middle), 0., []
        for k, y in enumerate(path):
            phi, m = k * math.pi / (len(path) - 1), self.m
            radial, hoop, shear, s_e, e_r, e_hoop, e_shear = self.at(y)
            largest = max(largest, s_e)
            u_r, u = e_r / (m + 1), y[4]
            turn_r = (y[3] + 2 * (m + 1) * e_shear) / (m + 1) - u
            turn = e_hoop  # u' + u_r
            cos, sin = math.cos(phi), math.sin(phi)
            integrand.append(
                self.n / (self.n + 1) * s_e ** (self.n + 1) * cos
                - radial * ((m + 1) * u_r * cos - turn_r * sin)
                - shear * ((m + 1) * u * cos - turn * sin))
        integral = 2 * math.pi / (len(path) - 1) * (
            sum(integrand) - 0.5 * (integrand[0] + integrand[-1]))
        hoop_ahead = self.at(path[0])[1]
        return integral / largest ** (self.n + 1), hoop_ahead / largest
