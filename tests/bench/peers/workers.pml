/* Workers of whom three may work at a time: workers.csp. A state has 3 bits for each worker. */
#ifndef N
#define N 32
#endif

byte working;
byte event; /* set to 0 where something happens that nobody else sees */

active [N] proctype worker() {
  do
  :: d_step { working < 3 -> working++ };
     event = 0; event = 0; event = 0; event = 0; event = 0;
     working--
  od
}
