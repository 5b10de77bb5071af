"""Formulas of the features: y, and the column of its Jacobian for one dof, in TeX.

A dof moves frame a with the velocity v_a of its origin and the angular velocity w_a, per unit of the dof: for a hinge
with the unit axis u through the point c, w_a = u and v_a = u x (p_a - c) if the frame is below the hinge; for a slide
w_a = 0 and v_a = u; 0 for other frames. A test evaluates the same formulas by NumPy.
"""

AXES = "XYZ"


def _frameFormulas() -> dict[str, tuple[str, str]]:
    """Families of position, quaternion, pose, axes and products of axes."""
    half = r"\tfrac12 (0, \omega_a)\, q_a"
    rows = {
        "position": (r"p_a", r"v_a"),
        "positionDiff": (r"p_a - p_b", r"v_a - v_b"),
        "positionRel": (r"R_b^\top (p_a - p_b)", r"R_b^\top (v_a - v_b - \omega_b \times (p_a - p_b))"),
        "quaternion": (r"q_a", half),
        "quaternionDiff": (r"q_a \mp q_b", half + r" \mp \tfrac12 (0, \omega_b)\, q_b"),
        "quaternionRel": (r"q_b^{-1} q_a", r"\tfrac12 (0, R_b^\top (\omega_a - \omega_b))\, y"),
        "pose": (r"(p_a,\ q_a)", r"\text{those of position and quaternion}"),
        "poseDiff": (r"(p_a - p_b,\ q_a \mp q_b)", r"\text{those of positionDiff and quaternionDiff}"),
        "poseRel": (r"(R_b^\top (p_a - p_b),\ q_b^{-1} q_a)", r"\text{those of positionRel and quaternionRel}"),
        "gazeAt": (
            r"[R_b^\top (p_a - p_b)]_{xy}",
            r"[R_b^\top (v_a - v_b - \omega_b \times (p_a - p_b))]_{xy}",
        ),
    }
    for axis in AXES:
        e = f"e_{axis.lower()}"
        rows[f"vector{axis}"] = (rf"R_a {e}", rf"\omega_a \times R_a {e}")
        rows[f"vector{axis}Diff"] = (
            rf"R_a {e} - R_b {e}",
            rf"\omega_a \times R_a {e} - \omega_b \times R_b {e}",
        )
        if axis != "Z":
            rows[f"Align{axis}WithDiff"] = (
                rf"\frac{{d}}{{\sqrt{{\lVert d \rVert^2 + 10^{{-8}}}}}} - R_a {e},\ d = p_{{b,t}} - p_{{b,t-1}}",
                rf"\text{{of }} d \text{{, and }} -\omega_a \times R_a {e}",
            )
        rows[f"vector{axis}Rel"] = (
            rf"R_b^\top R_a {e}",
            rf"R_b^\top ((\omega_a - \omega_b) \times R_a {e})",
        )
        for other in AXES:
            f = f"e_{other.lower()}"
            rows[f"scalarProduct{axis}{other}"] = (
                rf"(R_a {e})^\top R_b {f}",
                rf"(\omega_a - \omega_b)^\top (R_a {e} \times R_b {f})",
            )
    return rows


# n: the unit normal from b to a; s_a, s_b: the nearest points of the shapes; d: their distance; c: center of mass.
FORMULAS: dict[str, tuple[str, str]] = {
    **_frameFormulas(),
    "qItself": (r"q", r"\text{unit vector}"),
    "jointLimits": (r"(l - q,\ q - u)", r"\mp \text{unit vector}"),
    "qQuaternionNorms": (r"\lVert q_i \rVert^2 - 1", r"2 q_i"),
    "distance": (r"-d(a, b)", r"-n^\top (v_{s_a} - v_{s_b})"),
    "pairCollision_negScalar": (r"-d(a, b)", r"-n^\top (v_{s_a} - v_{s_b})"),
    "pairCollision_vector": (r"s_a - s_b", r"\text{central differences of } s_a - s_b"),
    "pairCollision_normal": (r"n", r"\text{central differences of } n"),
    "pairCollision_p1": (r"s_a", r"\text{central differences of } s_a"),
    "pairCollision_p2": (r"s_b", r"\text{central differences of } s_b"),
    "accumulatedCollisions": (r"\sum_i \max(0, -d_i)", r"-\sum_{d_i < 0} n_i^\top (v_{s_a} - v_{s_b})"),
    "pairCollisions": (r"-d_i", r"-n_i^\top (v_{s_a} - v_{s_b})"),
    "oppose": (r"v_1 + v_2,\ v_i = s_i - s_o", r"\dot v_1 + \dot v_2"),
    "opposeCentral": (
        r"(v_1 + v_2,\ 0.01\,(2 \hat p_{12} + \hat v_1 - \hat v_2))",
        r"(\dot v_1 + \dot v_2,\ 0.01\,(2 \dot{\hat p}_{12} + \dot{\hat v}_1 - \dot{\hat v}_2))",
    ),
    "aboveBox": (r"(x - h,\ -x - h)_{xy},\ x = R_b^\top (p_a - p_b)", r"\pm \dot x"),
    "insideBox": (r"(x - h,\ -x - h),\ x = R_b^\top (p_a - p_b)", r"\pm \dot x"),
    "standingAbove": (r"z_a - z_b - \tfrac12 (h_a + h_b)", r"[v_a - v_b]_z"),
    "angularVel": (r"\tfrac{2}{\tau} \operatorname{vec}(q_t\, q_{t-1}^{-1})", r"\approx \tfrac1\tau \omega_a"),
    "linangVel": (
        r"(\tfrac1\tau (p_t - p_{t-1}),\ \tfrac{2}{\tau} \operatorname{vec}(q_t\, q_{t-1}^{-1}))",
        r"\approx \tfrac1\tau (v_a, \omega_a)",
    ),
    "energy": (
        r"\sum_i m_i (\tfrac12 \lVert \dot c_i \rVert^2 + g z_i)",
        r"\sum_i m_i (\tfrac1\tau \dot c_i + g e_z)^\top v_{c_i}",
    ),
    "EqCenterOfMass": (r"p_a - \frac{\sum_i m_i c_i}{\sum_i m_i}", r"v_a - \frac{\sum_i m_i v_{c_i}}{\sum_i m_i}"),
    "physics": (
        r"(\Delta v + (g e_z - \tfrac{F}{m}) \tau,\ \Delta \omega - I^{-1} (T - \omega \times I \omega) \tau)",
        r"\text{of three slices}",
    ),
    "totalForce": (r"(m g e_z - \sum_i f_i,\ \sum_i (p_i - c) \times f_i)", r"\text{of } f_i,\ p_i,\ c"),
    "contactConstraints": (r"f - n n^\top f", r"\text{of } f \text{ and } n"),
}
