# a continuous beam on N compliant frictional supports, pulses that lift it
import sys
N=int(sys.argv[1]); per=int(sys.argv[2]) if len(sys.argv)>2 else 2
out=['schema = 1','title = "A beam on %d supports"'%N,'units = { force = "kN", mass = "t", length = "m", time = "s" }','gravity = [0.0, -9.81]','[run]','t_end = 0.5','initial = "static"','output_dt = 1e-2','[damping]','alpha = 4.0','[sections.pipe]','EA = 9.0e6','EI = 2.0e4','mass_per_length = 0.4','[nodes]']
for i in range(N): out.append('P%d = [%g, 0.0]'%(i,3.0*i))
out+=['[[members]]','nodes = [%s]'%', '.join('"P%d"'%i for i in range(N)),'section = "pipe"','elements = %d'%per]
for i in range(N): out+=['[[contacts]]','name = "c%d"'%i,'node = "P%d"'%i,'normal = [0.0, 1.0]','law = "compliant"','normal_stiffness = 1e6','tangential_stiffness = 1e6','friction = 0.3']
k=[N//4,N//2]
for j,i in enumerate(k): out+=['[[loads]]','node = "P%d"'%i,'direction = [0.7071067811865476, 0.7071067811865476]','amplitude = 60.0','history = { type = "rectangle", start = %g, end = %g }'%(0.02*j,0.02*j+0.05)]
print('\n'.join(out))
