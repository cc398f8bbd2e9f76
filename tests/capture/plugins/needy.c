/* A driver whose library is not there when it is loaded. */
int turnscan_absent(void);
const void* turnscan_plugin_entry(void);
const void* turnscan_plugin_entry(void) {
  return turnscan_absent() ? (const void*)0 : (const void*)1;
}
