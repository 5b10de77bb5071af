"""The elements and attributes of MJCF that the reader takes, with what becomes of them."""

from . import mjcf_bodies, mjcf_sections

SECTIONS = {
    title: (text, part.DOCUMENT, entries)
    for part in (mjcf_bodies, mjcf_sections)
    for title, (text, entries) in part.SECTIONS.items()
}
NOT_READ = "Read as nothing, with a warning: `<composite>`, `<flexcomp>`, `<plugin>`, `<deformable>`, `<tendon>`, `<sensor>`, other kinds of `<equality>`, `solref`, `solimp`, `priority`, `margin`, `gap`, `springdamper`, and wind and fluids of `<option>`. `<visual>`, `<statistic>`, `<size>`, `<custom>` and `<extension>` are skipped."
