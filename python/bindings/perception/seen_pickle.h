#pragma once

namespace kinegraph::python {

/// Lets DepthView, SeenFrame, SeenCamera and SeenScene be pickled and copied.
void bindSeenCopies();

}  // namespace kinegraph::python
