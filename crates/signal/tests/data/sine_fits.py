"""Four-parameter sine fits with one harmonic, by scipy.optimize.least_squares (lm) and Gauss-Newton
steps after it, of the
recording x[i] = round(1e5 (0.7 + 1.25 cos(w i + 0.4) + 0.03 cos(2 w i - 1) + 0.01 s(i))) / 1e5,
s(i) = (i*i*7919 mod 10007)/10007 - 1/2, w = 2 pi cycles. Phases about the middle of the record.

c3, a3, b3, a3_2, b3_2: constant, cosine and sine of the frequency and of its double at the given
cycles, by numpy.linalg.lstsq. found, c4, ...: the same with the cycles found by least squares.
variance: of the cycles for residuals of variance 1, from the inverse of J'J."""
import numpy as np
from scipy.optimize import least_squares
rows=[]
for cycles,n in [(0.0103,1000),(0.0171,200),(0.2101,1500),(0.00311,20000)]:
    i=np.arange(n); w=2*np.pi*cycles
    x=np.round(1e5*(0.7+1.25*np.cos(w*i+0.4)+0.03*np.cos(2*w*i-1)+0.01*((i*i*7919%10007)/10007-0.5)))/1e5
    tau=i-(n-1)/2
    def design(c):
        a=2*np.pi*c*tau
        return np.stack([np.ones(n),np.cos(a),np.sin(a),np.cos(2*a),np.sin(2*a)],1)
    lin=np.linalg.lstsq(design(cycles),x,rcond=None)[0]
    # scaled cycles so that all parameters are of the size of one
    def res(p): return design(cycles+p[5]/n)@p[:5]-x
    def jac(p):
        c=cycles+p[5]/n; X=design(c); t=2*np.pi*tau/n
        d=t*(-p[1]*X[:,2]+p[2]*X[:,1]+2*(-p[3]*X[:,4]+p[4]*X[:,3]))
        return np.column_stack([X,d])
    s=least_squares(res,np.append(lin,0.0),jac=jac,method='lm',xtol=1e-15,ftol=1e-15,gtol=1e-15,max_nfev=1000)
    p=s.x
    for _ in range(5): # Gauss-Newton to the last bit
        p=p-np.linalg.lstsq(jac(p),res(p),rcond=None)[0]
    var=np.linalg.inv(jac(p).T@jac(p))[5,5]/n**2
    rows.append((cycles,n,*lin,cycles+p[5]/n,*p[:5],var))
print("cycles,samples,c3,a3,b3,a3_2,b3_2,found,c4,a4,b4,a4_2,b4_2,variance")
for r in rows: print(",".join(repr(float(v)) if k!=1 else str(v) for k,v in enumerate(r)))
