/* The philosophers of corpus/philosophers/philosophers.csp: SYSTEM(N), one transition for each event. */
#ifndef N
#define N 8
#endif

bool taken[N];
byte event; /* set to 0 where something happens that nobody else sees */

active [N] proctype philosopher() {
  do
  :: event = 0;                                /* sits */
     d_step { !taken[_pid] -> taken[_pid] = true };
     d_step { !taken[(_pid + 1) % N] -> taken[(_pid + 1) % N] = true };
     event = 0;                                /* eats */
     taken[(_pid + 1) % N] = false;
     taken[_pid] = false;
     event = 0                                 /* gets up */
  od
}
