"""How the sample parts are drawn: one module for each class, all with the same pen."""
