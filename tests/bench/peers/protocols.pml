/* Alternating-bit protocols over lines that lose messages, side by side: protocols.csp. Breadth-first
   search stores the middle of a rendezvous as a state, so that each protocol is one process here, which
   moves its four parts by guarded commands; a state here is a state there. */
#ifndef N
#define N 3
#endif

/* Places. Sender: idle, sending; receiver: waits, delivers, replies; each with its bit. */
byte sender[N];   /* 0, 1: idle with this bit; 2, 3: sending it */
byte receiver[N]; /* 0, 1: waits for this bit; 2, 3: delivers it; 4, 5: replies it */
byte forth[N];    /* 0: ready; 1, 2: has received 0 or 1; 3, 4: passes it on */
byte back[N];

#define i _pid

active [N] proctype protocol() {
  do
  :: d_step { sender[i] == 0 -> sender[i] = 2 }
  :: d_step { sender[i] == 2 && forth[i] == 0 -> forth[i] = 1 }
  :: d_step { sender[i] == 2 && back[i] == 3 -> back[i] = 0; sender[i] = 1 }
  :: d_step { sender[i] == 2 && back[i] == 4 -> back[i] = 0 }
  :: d_step { forth[i] == 1 -> forth[i] = 3 }
  :: d_step { forth[i] == 1 -> forth[i] = 0 }
  :: d_step { back[i] == 1 -> back[i] = 3 }
  :: d_step { back[i] == 1 -> back[i] = 0 }
  :: d_step { receiver[i] == 0 && forth[i] == 3 -> forth[i] = 0; receiver[i] = 2 }
  :: d_step { receiver[i] == 0 && forth[i] == 4 -> forth[i] = 0; receiver[i] = 5 }
  :: d_step { receiver[i] == 2 -> receiver[i] = 4 }
  :: d_step { receiver[i] == 4 && back[i] == 0 -> back[i] = 1; receiver[i] = 1 }
  :: d_step { sender[i] == 1 -> sender[i] = 3 }
  :: d_step { sender[i] == 3 && forth[i] == 0 -> forth[i] = 2 }
  :: d_step { sender[i] == 3 && back[i] == 4 -> back[i] = 0; sender[i] = 0 }
  :: d_step { sender[i] == 3 && back[i] == 3 -> back[i] = 0 }
  :: d_step { forth[i] == 2 -> forth[i] = 4 }
  :: d_step { forth[i] == 2 -> forth[i] = 0 }
  :: d_step { back[i] == 2 -> back[i] = 4 }
  :: d_step { back[i] == 2 -> back[i] = 0 }
  :: d_step { receiver[i] == 1 && forth[i] == 4 -> forth[i] = 0; receiver[i] = 3 }
  :: d_step { receiver[i] == 1 && forth[i] == 3 -> forth[i] = 0; receiver[i] = 4 }
  :: d_step { receiver[i] == 3 -> receiver[i] = 5 }
  :: d_step { receiver[i] == 5 && back[i] == 0 -> back[i] = 2; receiver[i] = 0 }
  od
}
