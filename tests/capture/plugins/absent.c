/* A library that a driver needs and that is taken away before it is loaded. */
int turnscan_absent(void);
int turnscan_absent(void) { return 1; }
