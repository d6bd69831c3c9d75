import numpy as np
from scipy import signal
cases=[("low",6,[40.0],1612.0),("low",5,[40.0],1612.0),("high",1,[0.3],1000.0),("high",4,[0.2],200.0),("band",2,[4.75,5.25],1612.0),("band",8,[5.0,20.0],1000.0),("band",6,[2.0,300.0],1000.0)]
K={"low":"lowpass","high":"highpass","band":"bandpass"}
print("# Butterworth filters of scipy %s: signal.butter(n, corners, output='sos'), sosfilt from rest, sosfreqz."%__import__("scipy").__version__)
print("# Input: x[k] = sin(0.7 k) + 0.3 (k mod 7). Output at 1, 10, 100, 400; gain at 3, 5, 20, 90 Hz as re im.")
print("kind,poles,low,high,rate,"+",".join("y%d"%i for i in(1,10,100,400))+","+",".join("re%g,im%g"%(f,f) for f in(3,5,20,90)))
k=np.arange(401);x=np.sin(0.7*k)+0.3*(k%7)
for kind,poles,c,rate in cases:
    n=poles//2 if kind=="band" else poles
    sos=signal.butter(n,c if len(c)>1 else c[0],K[kind],output='sos',fs=rate)
    y=signal.sosfilt(sos,x)
    w,h=signal.sosfreqz(sos,worN=np.array([3,5,20,90.0]),fs=rate)
    print(",".join([kind,str(poles),repr(c[0]),repr(c[-1]),repr(rate)]+[repr(float(y[i])) for i in(1,10,100,400)]+[f"{float(z.real)!r},{float(z.imag)!r}" for z in h]))
