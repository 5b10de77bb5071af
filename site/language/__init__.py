"""References of the scene formats, attribute by attribute. A test checks the effect of each row's example."""
